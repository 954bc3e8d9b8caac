#include "GLTF_accessor.h"
#include "numbers.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace Tool {

namespace {

// numbers of types in glTF files, by Number_type; 0 if there is none
constexpr int component_types[] = { TINYGLTF_COMPONENT_TYPE_BYTE,
                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                    TINYGLTF_COMPONENT_TYPE_SHORT,
                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                    0,
                                    TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                    TINYGLTF_COMPONENT_TYPE_FLOAT,
                                    0 };

std::optional<Number_type> type_of(int component_type)
{
  const auto found = std::find(std::begin(component_types), std::end(component_types), component_type);
  if(component_type == 0 || found == std::end(component_types)) return std::nullopt;
  return Number_type(found - std::begin(component_types));
}

std::size_t size_of(Number_type type)
{
  return with_type(type, [](auto zero) { return sizeof zero; });
}

double number_at(Number_type type, const unsigned char* bytes)
{
  return with_type(type, [&](auto x) {
    std::memcpy(&x, bytes, sizeof x);
    return double(x);
  });
}

// Returns rows of bytes in a view, or null if the view does not have all of them.
const unsigned char* rows_of_view(const tinygltf::Model& gltf, int view, std::size_t offset, std::size_t number,
                                  std::size_t row, std::size_t stride)
{
  const unsigned char* const bytes = bytes_of_view(gltf, view);
  if(bytes == nullptr) return nullptr;
  const std::size_t size = gltf.bufferViews[std::size_t(view)].byteLength;
  if(number == 0) return bytes;
  if(offset > size || row > size - offset || number - 1 > (size - offset - row) / stride) return nullptr;
  return bytes + offset;
}

} // namespace

void GLTF_values::make_real()
{
  if(is_normalized) {
    const double largest = with_type(type,
                                     [](auto zero) { return double((std::numeric_limits<decltype(zero)>::max)()); });
    for(double& x : values) x = (std::max)(x / largest, -1.);
  }
  is_normalized = false;
  type = Number_type::FLOAT32;
}

const unsigned char* bytes_of_view(const tinygltf::Model& gltf, int view)
{
  if(view < 0 || std::size_t(view) >= gltf.bufferViews.size()) return nullptr;
  const tinygltf::BufferView& v = gltf.bufferViews[std::size_t(view)];
  if(v.buffer < 0 || std::size_t(v.buffer) >= gltf.buffers.size()) return nullptr;
  const std::vector<unsigned char>& data = gltf.buffers[std::size_t(v.buffer)].data;
  const bool is_inside = v.byteOffset < data.size() && v.byteLength <= data.size() - v.byteOffset;
  return is_inside ? data.data() + v.byteOffset : nullptr;
}

std::optional<GLTF_values> read_accessor(const tinygltf::Model& gltf, int accessor)
{
  if(accessor < 0 || std::size_t(accessor) >= gltf.accessors.size()) return std::nullopt;
  const tinygltf::Accessor& a = gltf.accessors[std::size_t(accessor)];
  const std::optional<Number_type> type = type_of(a.componentType);
  const bool is_vector = a.type == TINYGLTF_TYPE_SCALAR || a.type == TINYGLTF_TYPE_VEC2 || a.type == TINYGLTF_TYPE_VEC3
                         || a.type == TINYGLTF_TYPE_VEC4;
  if(!type || !is_vector) return std::nullopt;
  GLTF_values found;
  found.type = *type;
  found.is_normalized = a.normalized && !is_real(*type);
  found.dimension = std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(a.type)));
  const std::size_t size = size_of(*type), row = size * found.dimension;
  const auto copy_row = [&](const unsigned char* from, std::size_t n) {
    for(std::size_t i = 0; i < found.dimension; ++i)
      found.values[n * found.dimension + i] = number_at(*type, from + i * size);
  };

  if(a.bufferView >= 0) {
    if(std::size_t(a.bufferView) >= gltf.bufferViews.size()) return std::nullopt;
    const std::size_t given = gltf.bufferViews[std::size_t(a.bufferView)].byteStride, stride = given > 0 ? given : row;
    const unsigned char* const rows = rows_of_view(gltf, a.bufferView, a.byteOffset, a.count, row, stride);
    if(rows == nullptr) return std::nullopt;
    found.values.resize(a.count * found.dimension);
    for(std::size_t n = 0; n < a.count; ++n) copy_row(rows + n * stride, n);
  } else {
    // Zeros need no bytes of the file, whose size limits their number nevertheless.
    std::size_t bytes = 0;
    for(const tinygltf::Buffer& buffer : gltf.buffers) bytes += buffer.data.size();
    if(a.count > bytes) return std::nullopt;
    found.values.resize(a.count * found.dimension, 0);
  }
  if(!a.sparse.isSparse) return found;

  const auto& sparse = a.sparse;
  const std::optional<Number_type> index_type = type_of(sparse.indices.componentType);
  if(!index_type || is_real(*index_type) || sparse.count < 0) return std::nullopt;
  const std::size_t index_size = size_of(*index_type), number = std::size_t(sparse.count);
  const unsigned char* const indices = rows_of_view(
    gltf, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), number, index_size, index_size);
  const unsigned char* const rows = rows_of_view(gltf, sparse.values.bufferView, std::size_t(sparse.values.byteOffset),
                                                 number, row, row);
  if(indices == nullptr || rows == nullptr) return std::nullopt;
  for(std::size_t n = 0; n < number; ++n) {
    const double index = number_at(*index_type, indices + n * index_size);
    if(!(index >= 0 && index < double(a.count))) return std::nullopt;
    copy_row(rows + n * row, std::size_t(index));
  }
  return found;
}

int append_view(tinygltf::Model& gltf, const std::vector<unsigned char>& bytes)
{
  if(gltf.buffers.empty()) gltf.buffers.emplace_back();
  std::vector<unsigned char>& data = gltf.buffers[0].data;
  data.resize((data.size() + 3) / 4 * 4, 0);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  data.insert(data.end(), bytes.begin(), bytes.end());
  gltf.bufferViews.push_back(std::move(view));
  return int(gltf.bufferViews.size()) - 1;
}

int append_accessor(tinygltf::Model& gltf, const GLTF_values& values, int target)
{
  // Rows of values of vertices begin at multiples of four bytes.
  const std::size_t row = size_of(values.type) * values.dimension;
  const std::size_t stride = target == TINYGLTF_TARGET_ARRAY_BUFFER ? (row + 3) / 4 * 4 : row;
  std::vector<unsigned char> bytes(values.size() * stride, 0);
  for(std::size_t n = 0; n < values.values.size(); ++n)
    with_type(values.type, [&](auto zero) {
      const auto x = rounded_to<decltype(zero)>(values.values[n]);
      std::memcpy(&bytes[n / values.dimension * stride + n % values.dimension * sizeof x], &x, sizeof x);
    });
  tinygltf::Accessor a;
  a.bufferView = append_view(gltf, bytes);
  a.componentType = component_types[std::size_t(values.type)];
  a.normalized = values.is_normalized;
  a.count = values.size();
  a.type = values.dimension == 1 ? TINYGLTF_TYPE_SCALAR : int(values.dimension);
  gltf.bufferViews.back().target = target;
  if(stride != row) gltf.bufferViews.back().byteStride = stride;
  gltf.accessors.push_back(std::move(a));
  return int(gltf.accessors.size()) - 1;
}

} // namespace Tool
