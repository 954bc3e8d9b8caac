// Counts results by kind and verdict, and stores descriptions of wrong results.
#ifndef TALLY_H
#define TALLY_H

#include <CGAL/Bspline_shell_3/Shell/Certificate_report.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

class Tally
{
public:
  void begin(std::uint64_t number) { m_case = number; }

  void count(const std::string& kind, CGAL::Bspline_shells::Verdict verdict)
  {
    ++m_counts[kind].by_verdict[std::size_t(verdict)];
  }
  void wrong(const std::string& kind, const std::string& what)
  {
    ++m_counts[kind].wrong;
    if(m_descriptions.size() < most_descriptions) m_descriptions.emplace_back(m_case, kind + ": " + what);
  }

  // Counts a right or wrong result that is not a verdict.
  void count(const std::string& kind, bool is_right, const std::string& what)
  {
    count(kind, CGAL::Bspline_shells::Verdict::PROVED);
    if(!is_right) wrong(kind, what);
  }

  void add(const Tally& other)
  {
    for(const auto& kind : other.m_counts) {
      for(std::size_t v = 0; v < 3; ++v) m_counts[kind.first].by_verdict[v] += kind.second.by_verdict[v];
      m_counts[kind.first].wrong += kind.second.wrong;
    }
    m_descriptions.insert(m_descriptions.end(), other.m_descriptions.begin(), other.m_descriptions.end());
    std::sort(m_descriptions.begin(), m_descriptions.end());
  }

  std::size_t answers() const
  {
    std::size_t sum = 0;
    for(const auto& kind : m_counts)
      for(std::size_t n : kind.second.by_verdict) sum += n;
    return sum;
  }
  std::size_t wrong_answers() const
  {
    std::size_t sum = 0;
    for(const auto& kind : m_counts) sum += kind.second.wrong;
    return sum;
  }

  // Returns the first descriptions of wrong results, with the numbers of their cases.
  const std::vector<std::pair<std::uint64_t, std::string> >& descriptions() const { return m_descriptions; }

  void write_json(std::ostream& out) const
  {
    const char* separator = "";
    out << '{';
    for(const auto& kind : m_counts) {
      out << separator << '"' << kind.first << "\": {\"proved\": " << kind.second.by_verdict[0]
          << ", \"refuted\": " << kind.second.by_verdict[1] << ", \"undecided\": " << kind.second.by_verdict[2]
          << ", \"wrong\": " << kind.second.wrong << '}';
      separator = ", ";
    }
    out << '}';
  }

private:
  struct Count
  {
    std::array<std::size_t, 3> by_verdict = {};
    std::size_t wrong = 0;
  };

  static constexpr std::size_t most_descriptions = 20;

  std::uint64_t m_case = 0;
  std::map<std::string, Count> m_counts;
  std::vector<std::pair<std::uint64_t, std::string> > m_descriptions;
};

#endif // TALLY_H
