// truncation_file.h: a truncation is read as it was written, whether or not it is valid.
#include <CGAL/Bspline_shell_3/IO/internal/truncation_file.h>
#include "truncations.h"

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace test_truncation_file {
namespace {

namespace BSI = CGAL::Bspline_shells::internal;
typedef Truncation_parts::Truncation Truncation;

// Writes and reads a truncation; null means that there is none.
std::shared_ptr<const Truncation> written_and_read(const Truncation* truncation, bool is_binary)
{
  std::stringstream file;
  {
    BSI::File_output out(file);
    BSI::write_truncation(BSI::Row_output(out, is_binary), truncation);
    REQUIRE(out.flush());
  }
  BSI::File_input in(file);
  std::shared_ptr<const Truncation> read;
  REQUIRE(BSI::read_truncation(BSI::Row_input(in, is_binary), read));
  return read;
}

Truncation_parts parts()
{
  const Mesh mesh = sphere(1);
  const Mesh::Vertex_index v(0);
  return truncation_at(mesh, { v, mesh.source(mesh.halfedge(v)) }, true);
}

} // namespace

TEST_CASE("Truncation files: a truncation is read exactly as it was written")
{
  for(bool is_binary : { false, true }) {
    const Truncation truncation = parts().assembled();
    const auto read = written_and_read(&truncation, is_binary);
    REQUIRE(read);
    CHECK(read->is_valid());
    CHECK(read->points() == truncation.points());
    CHECK(read->planar() == truncation.planar());
    CHECK(read->cut_facets() == truncation.cut_facets());
    CHECK(read->number_of_new_facets() == truncation.number_of_new_facets());
    for(std::size_t n = 0; n < truncation.number_of_new_facets(); ++n)
      CHECK(read->new_facet(n) == truncation.new_facet(n));
  }
}

TEST_CASE("Truncation files: an invalid truncation is still invalid when read")
{
  for(bool is_binary : { false, true }) {
    Truncation_parts gap = parts();
    gap.cores.pop_back();
    Truncation_parts turned = parts();
    std::swap(turned.discs[0].triangles[0][0], turned.discs[0].triangles[0][1]);
    for(const Truncation& truncation : { gap.assembled(), turned.assembled() }) {
      const auto read = written_and_read(&truncation, is_binary);
      REQUIRE(read);
      CHECK_FALSE(read->is_valid());
    }
    CHECK_FALSE(written_and_read(nullptr, is_binary));
  }
}
} // namespace test_truncation_file
