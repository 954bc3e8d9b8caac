// write_certificate.h: the text follows the format, for shells of both kinds. An independent program checks its claims
// (check_certificate_test.py).
#include <CGAL/Bspline_shell_3/IO/write_certificate.h>
#include "shell_files.h"

#include <sstream>
#include <string>
#include <vector>

namespace test_write_certificate {
namespace {

// Returns whether boxes of this kind cover the shell, provided that all claims are proved.
bool is_cover(const std::string& kind)
{
  return kind == "g" || kind == "b" || kind == "a";
}

template <typename Any_shell, typename Certificate>
void check_text(const Any_shell& shell, const Certificate& certificate)
{
  std::ostringstream out;
  REQUIRE(BS::write_certificate(out, shell, certificate));
  const std::string text = out.str();
  const Lines lines = lines_of(text);
  CHECK(text_of(lines) == text);
  CHECK(lines[0] == "cubic_bspline_shell_certificate 3");
  // The shell is identified by the checksum of its text file, the mesh by its contents.
  const std::string shell_text = written(shell, Format::ASCII);
  CHECK(lines[1] == "shell " + shell_text.substr(shell_text.size() - 17, 16));
  const auto& mesh = certificate.examined_mesh();
  CHECK(lines[2]
        == "mesh " + std::to_string(mesh.number_of_vertices()) + " " + std::to_string(mesh.number_of_faces()) + " "
             + BS::Checksum::text(BS::mesh_checksum(mesh)));
  CHECK(lines[3] == "verdicts proved proved proved proved proved");

  const std::vector<BS::Cover_box>& boxes = certificate.cover()->boxes();
  CHECK(lines[4] == "boxes " + std::to_string(boxes.size()));
  std::size_t covering = 0, wrong = 0;
  int last_leaf = 0;
  for(std::size_t n = 5; n < 5 + boxes.size(); ++n) {
    const std::vector<std::string> words = words_of(lines[n]);
    REQUIRE(words.size() >= 6);
    wrong += std::stoi(words[0]) < last_leaf || words.size() != (is_cover(words[5]) ? 9 : 6)
             || std::string("xgbao").find(words[5]) == std::string::npos;
    last_leaf = std::stoi(words[0]);
    covering += is_cover(words[5]);
  }
  CHECK(wrong == 0);
  CHECK(std::size_t(last_leaf) < shell.field().number_of_cells());
  CHECK(covering == certificate.statistics().cover_boxes);
  const std::size_t seeds = 5 + boxes.size();
  REQUIRE(lines.size() == seeds + 5);
  CHECK(lines[seeds] == "seeds 1");
  CHECK(lines[seeds + 1] == "0 " + std::to_string(std::size_t(certificate.seeds()[0])));
  CHECK(lines[seeds + 2] == "covers 1");
  CHECK(lines[seeds + 3] == "paths 1");
  const std::vector<std::string> path = words_of(lines[seeds + 4]);
  REQUIRE(path.size() == 8);
  CHECK(std::stod(path[2]) == certificate.paths()[0].source[0]);
  CHECK(std::stod(path[7]) == certificate.paths()[0].target[2]);

  const Temporary_file file("some.certificate.txt");
  CHECK(BS::write_certificate(file.name, shell, certificate));
  CHECK(contents(file.name) == text);
  CHECK_FALSE(BS::write_certificate("no_such_folder/some.certificate.txt", shell, certificate));
  for(std::size_t capacity : { std::size_t(0), std::size_t(100), text.size() - 1 }) {
    Full_disk disk(capacity);
    std::ostream full(&disk);
    CHECK_FALSE(BS::write_certificate(full, shell, certificate));
  }
}

} // namespace

TEST_CASE("Certificate files: the text follows the format, on equal cells between two levels")
{
  const Mesh mesh = sphere(2);
  const Shell shell = CGAL::bspline_shell_3(mesh, BS::parameters::resolution(12));
  REQUIRE(shell);
  BS::Shell_certificate_3<> certificate(shell);
  REQUIRE(certificate.verify(mesh));
  check_text(shell, certificate);
}

TEST_CASE("Certificate files: the text follows the format, on a hierarchy between varying thresholds")
{
  const Mesh mesh = box(Point_3(0.1, 0, 0), Point_3(1.1, 0.7, 0.3));
  const Varying_shell shell = CGAL::certified_bspline_shell_3(mesh,
                                                              BS::parameters::resolution(8).relative_thickness(0.02));
  REQUIRE(shell.is_certified());
  REQUIRE(shell.field().number_of_levels() > 1);
  BS::Shell_certificate_3<Varying_shell::Field, Varying_shell::Threshold> certificate(shell);
  REQUIRE(certificate.verify(mesh));
  check_text(shell, certificate);
}
} // namespace test_write_certificate
