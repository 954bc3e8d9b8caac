// Numbers in the buffers of glTF files.
#ifndef TOOL_FILES_GLTF_ACCESSOR_H
#define TOOL_FILES_GLTF_ACCESSOR_H

#include "Model.h"

#include <cstddef>
#include <optional>
#include <vector>

#include <tiny_gltf.h>

namespace Tool {

struct GLTF_values
{
  Number_type type = Number_type::FLOAT32;
  bool is_normalized = false; // whether integers stand for numbers from 0 to 1, or from -1 to 1
  std::size_t dimension = 1;
  std::vector<double> values;

  std::size_t size() const { return values.size() / dimension; }
  // Replaces normalized integers by the numbers for which they stand.
  void make_real();
};

// Returns the values of an accessor, or nothing if it is damaged, or has matrices.
std::optional<GLTF_values> read_accessor(const tinygltf::Model& gltf, int accessor);

// Appends values to the first buffer, and returns their accessor.
// \param target of the view of the buffer, as in the specification of glTF
int append_accessor(tinygltf::Model& gltf, const GLTF_values& values, int target);

// Returns the bytes of a view, or null if it is damaged.
const unsigned char* bytes_of_view(const tinygltf::Model& gltf, int view);

// Appends bytes to the first buffer, at a multiple of four, and returns their view.
int append_view(tinygltf::Model& gltf, const std::vector<unsigned char>& bytes);

} // namespace Tool

#endif // TOOL_FILES_GLTF_ACCESSOR_H
