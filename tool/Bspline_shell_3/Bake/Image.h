// Images in files.
#ifndef TOOL_BAKE_IMAGE_H
#define TOOL_BAKE_IMAGE_H

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace Tool {

typedef std::array<double, 3> Color; // red, green, and blue, from 0 to 255

// Rows follow each other from the top.
struct Image
{
  std::size_t width = 0, height = 0;
  std::vector<unsigned char> values; // three for each texel

  Image() = default;
  Image(std::size_t width, std::size_t height) : width(width), height(height), values(3 * width * height, 0) {}

  Color at(std::size_t texel) const
  {
    return { double(values[3 * texel]), double(values[3 * texel + 1]), double(values[3 * texel + 2]) };
  }
  void set(std::size_t texel, const Color& color);
  // Interpolates between the centers of four texels. The image is repeated; v is 0 at the bottom.
  Color sample(double u, double v) const;
};

// Reads a PNG or JPEG file, or another format of stb_image.
std::optional<Image> read_image(const std::string& file);
// Reads the contents of such a file.
std::optional<Image> read_image(const std::vector<unsigned char>& contents);

// Returns the contents of a PNG file, or nothing if there is not enough memory.
std::optional<std::string> png_of(const Image& image);

} // namespace Tool

#endif // TOOL_BAKE_IMAGE_H
