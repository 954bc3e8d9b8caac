// Checks proofs and refutations of the library against exact arithmetic and brute force, on random input close to
// changes of the verdict. Prints one JSON line with the numbers of results by kind and verdict, and of wrong ones.
//
//   fuzz_proofs --seconds S --seed N [--threads T] [--case C | --kind K]
//
// A case depends only on the seed and its number; the number of cases depends on the time. --case: only this case.
// --kind: only cases of this kind, from 0 to 17; 17 is excision.
// Wrong results are described on stderr, with their seed and case, and the exit code is 1.
#include "check_certificate.h"
#include "check_cover.h"
#include "check_excisions.h"
#include "check_geometry.h"
#include "check_predicates.h"
#include "check_shells.h"

#include <CGAL/Real_timer.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Returns thresholds at or close to the extrema of the field on a triangle.
std::pair<BS::Constant_threshold, BS::Constant_threshold> random_thresholds(CGAL::Random& random, const Random_cells&,
                                                                            const Field& field, const Triangle& t,
                                                                            const BS::Constant_threshold*)
{
  const auto value = [&](const std::array<double, 3>& p) { return rounded_value(field, p); };
  const auto negative = [&](const std::array<double, 3>& p) { return -value(p); };
  const double size = magnitude(field, t[0]), least = random_bound(random, t, value, size),
               most = -random_bound(random, t, negative, size);
  const bool is_close = random.get_bool();
  const double inner = is_close ? least : least - size * power_of_ten(random, -4, 0);
  const double outer = !is_close || random.get_bool() ? most : most + size * power_of_ten(random, -4, 0);
  return { BS::Constant_threshold(std::isfinite(inner) ? inner : 0),
           BS::Constant_threshold(std::isfinite(outer) ? outer : 0) };
}

std::pair<BS::Spline_threshold<Field>, BS::Spline_threshold<Field> > random_thresholds(
  CGAL::Random& random, const Random_cells& cells, const Field& field, const Triangle& t,
  const BS::Spline_threshold<Field>*)
{
  typedef BS::Spline_threshold<Field> Threshold;
  const double size = magnitude(field, t[0]);
  const auto threshold = [&](double sign, bool is_close) {
    const double steepness = chance(random, 0.5) ? power_of_ten(random, -4, -1) : power_of_ten(random, -1, 0.5);
    Eigen::VectorXd x = chance(random, 0.3)
                          ? Eigen::VectorXd(random.get_double(0.5, 1) * field.coefficients())
                          : Eigen::VectorXd(steepness * size * random_coefficients(random, field, cells));
    if(chance(random, 0.2)) x += power_of_ten(random, -12, -1) * size * random_coefficients(random, field, cells);
    Field spline = field;
    spline.set_coefficients(x);
    const auto margin = [&](const std::array<double, 3>& p) {
      return sign * (rounded_value(field, p) - rounded_value(spline, p));
    };
    const double least = random_bound(random, t, margin, size);
    if(!std::isfinite(least)) return Threshold(std::move(spline));
    const double shift = sign * (is_close ? least : least - size * power_of_ten(random, -4, 0));
    for(Eigen::Index n = 0; n < x.size(); ++n) x[n] += shift;
    spline.set_coefficients(std::move(x));
    return Threshold(std::move(spline));
  };
  const bool is_close = random.get_bool();
  Threshold inner = threshold(1, is_close), outer = threshold(-1, !is_close || random.get_bool());
  return { std::move(inner), std::move(outer) };
}

// Checks one field; each round has thresholds at a triangle.
template <typename Threshold>
void check_field(Tally& tally, CGAL::Random& random)
{
  typedef Exact_shell<Threshold> Shell;
  const Random_cells cells(random, random.get_int(1, 5));
  if(!cells.roots.is_exact()) return;
  const Field field = random_field(random, cells);
  const BS::Field_predicates_3<Field> predicates(field);
  const Exact_field exact(field);
  check_cells(tally, random, exact);
  for(int n = 0; n < 40; ++n) check_compare(tally, random, cells, exact);
  for(int round = 0; round < 4; ++round) {
    Triangle t = random_triangle(random, cells);
    if(chance(random, 0.3)) t = level_triangle(field, t);
    if(chance(random, 0.4)) t = grazing_triangle(random, field, t);
    else if(rounded_normal(t).dot(rounded_gradient(field, { t[0][0], t[0][1], t[0][2] })) < 0 && chance(random, 0.9))
      std::swap(t[1], t[2]);
    const auto thresholds = random_thresholds(random, cells, field, t, static_cast<const Threshold*>(nullptr));
    const Shell shell(field, thresholds.first, thresholds.second);
    const BS::Second_order_bounds_3<Field, Threshold> bounds(field, thresholds.first, thresholds.second);
    const Segment edge = { t[0], t[1] };
    check_levels(tally, random, shell, predicates, t);
    check_levels(tally, random, shell, predicates, edge);
    check_thresholds(tally, shell, predicates, t);
    check_thresholds(tally, shell, predicates, edge);
    check_slope(tally, random, shell, predicates, t);
    check_segment(tally, shell, predicates, edge);
    check_segment(tally, shell, predicates, Segment{ t[1], t[2] });
    for(const Point_3& p : t) check_is_beyond(tally, shell, predicates, p);
    check_examination(tally, random, shell, bounds, t);
    const Point_3 middles[] = { CGAL::midpoint(t[1], t[2]), CGAL::midpoint(t[2], t[0]), CGAL::midpoint(t[0], t[1]) };
    for(const Triangle& part : { Triangle{ t[0], middles[2], t[2] }, Triangle{ t[0], middles[2], middles[1] },
                                 Triangle{ t[1], middles[0], middles[2] }, Triangle{ t[2], middles[1], middles[0] } })
      if(!is_degenerate(part)) check_examination(tally, random, shell, bounds, part);
    if(chance(random, 0.3)) check_oracle(tally, random, shell, t);
    if(field.number_of_cells() <= 130 && chance(random, 0.15)) {
      std::vector<Point_3> seeds;
      for(const Point_3& p : { t[0], t[1], CGAL::centroid(t[0], t[1], t[2]) })
        if(field.locate(p) != Field::npos) seeds.push_back(p);
      Cover_check<Shell>(tally, random, shell, seeds);
    }
  }
}

constexpr std::uint64_t number_of_kinds = 18;

// Checks one case, which depends only on the two numbers.
void check_case(Tally& tally, std::uint64_t seed, std::uint64_t number)
{
  std::uint64_t hash = seed * 0x9e3779b97f4a7c15u + number;
  for(int n = 0; n < 3; ++n) hash = (hash ^ (hash >> 29)) * 0xbf58476d1ce4e5b9u;
  CGAL::Random random(static_cast<unsigned int>(hash >> 33));
  tally.begin(number);
  typedef BS::Constant_threshold Constant;
  switch(number % number_of_kinds) {
    case 0: Certificate_check<Constant>(tally, random); break;
    case 1: Certificate_check<BS::Spline_threshold<Field> >(tally, random); break;
    case 2:
    case 3:
      for(int n = 0; n < 20; ++n) {
        check_normal(tally, random);
        check_winding(tally, random);
        check_tricubics(tally, random);
      }
      check_crossings(tally, random);
      break;
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
    case 9: check_field<Constant>(tally, random); break;
    case 10: Shell_check(tally, random); break;
    case 17: Excision_check(tally, random); break;
    default: check_field<BS::Spline_threshold<Field> >(tally, random); break;
  }
}

int main(int argc, char** argv)
{
  double seconds = 60;
  std::uint64_t seed = 1, only = 0, first = 0, step = 1;
  unsigned int threads = (std::max)(1u, std::thread::hardware_concurrency());
  bool is_single = false;
  for(int n = 1; n < argc; n += 2) {
    const std::string option = argv[n];
    if(n + 1 == argc
       || (option != "--seconds" && option != "--seed" && option != "--threads" && option != "--case"
           && option != "--kind")) {
      std::cerr << "Usage: fuzz_proofs [--seconds S] [--seed N] [--threads T] [--case C | --kind K]\n";
      return 2;
    }
    if(option == "--seconds") seconds = std::atof(argv[n + 1]);
    if(option == "--seed") seed = std::strtoull(argv[n + 1], nullptr, 10);
    if(option == "--threads") threads = (std::max)(1u, unsigned(std::atoi(argv[n + 1])));
    if(option == "--kind") {
      step = number_of_kinds;
      first = std::strtoull(argv[n + 1], nullptr, 10) % step;
    }
    if(option == "--case") {
      only = std::strtoull(argv[n + 1], nullptr, 10);
      is_single = true;
    }
  }

  CGAL::Real_timer timer;
  timer.start();
  std::atomic<std::uint64_t> next(0);
  std::vector<Tally> tallies(is_single ? 1 : threads);
  const auto check_one = [seed](Tally& tally, std::uint64_t number) {
    try {
      check_case(tally, seed, number);
    } catch(const std::exception& e) {
      tally.wrong("exception", e.what());
    }
  };
  if(is_single) {
    check_one(tallies[0], only);
  } else {
    std::vector<std::thread> workers;
    const CGAL::Real_timer* clock = &timer;
    for(Tally& tally : tallies)
      workers.emplace_back([&next, &tally, &check_one, clock, seconds, first, step]() {
        while(clock->time() < seconds) check_one(tally, first + step * next++);
      });
    for(std::thread& worker : workers) worker.join();
  }
  Tally all;
  for(const Tally& tally : tallies) all.add(tally);

  constexpr std::size_t most_described = 10;
  for(std::size_t n = 0; n < (std::min)(most_described, all.descriptions().size()); ++n)
    std::cerr << "--seed " << seed << " --case " << all.descriptions()[n].first << ": " << all.descriptions()[n].second
              << '\n';
  std::cout << "{\"seed\": " << seed << ", \"seconds\": " << timer.time() << ", \"threads\": " << tallies.size()
            << ", \"cases\": " << (is_single ? 1 : next.load()) << ", \"answers\": " << all.answers()
            << ", \"wrong\": " << all.wrong_answers() << ", \"kinds\": ";
  all.write_json(std::cout);
  std::cout << "}\n";
  return all.wrong_answers() > 0;
}
