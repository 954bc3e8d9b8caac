#include "Image.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Tool {

namespace {

// Takes values from the library that reads images.
std::optional<Image> image_of(unsigned char* values, int width, int height)
{
  if(values == nullptr) return std::nullopt;
  Image image{ std::size_t(width), std::size_t(height) };
  std::copy_n(values, image.values.size(), image.values.begin());
  stbi_image_free(values);
  return image;
}

} // namespace

void Image::set(std::size_t texel, const Color& color)
{
  for(std::size_t i = 0; i < 3; ++i)
    values[3 * texel + i] = static_cast<unsigned char>(std::lround((std::min)((std::max)(color[i], 0.), 255.)));
}

Color Image::sample(double u, double v) const
{
  // Returns two neighboring positions, and the weight of the second one.
  const auto neighbors = [](double x, std::size_t size, std::array<std::size_t, 2>& at) {
    x = (x - std::floor(x)) * double(size) - 0.5;
    const double first = std::floor(x);
    at[0] = first < 0 ? size - 1 : std::size_t(first);
    at[1] = at[0] + 1 < size ? at[0] + 1 : 0;
    return x - first;
  };
  std::array<std::size_t, 2> column, row;
  const double right = neighbors(u, width, column), down = neighbors(1 - v, height, row);
  Color result = {};
  for(std::size_t i = 0; i < 2; ++i)
    for(std::size_t j = 0; j < 2; ++j) {
      const Color color = at(row[j] * width + column[i]);
      for(std::size_t k = 0; k < 3; ++k)
        result[k] += (i == 0 ? 1 - right : right) * (j == 0 ? 1 - down : down) * color[k];
    }
  return result;
}

std::optional<Image> read_image(const std::string& file)
{
  int width = 0, height = 0, channels = 0;
  unsigned char* const values = stbi_load(file.c_str(), &width, &height, &channels, 3);
  return image_of(values, width, height);
}

std::optional<Image> read_image(const std::vector<unsigned char>& contents)
{
  int width = 0, height = 0, channels = 0;
  unsigned char* const values = stbi_load_from_memory(contents.data(), int(contents.size()), &width, &height, &channels,
                                                      3);
  return image_of(values, width, height);
}

std::optional<std::string> png_of(const Image& image)
{
  std::string text;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), std::size_t(size));
  };
  const int is_complete = stbi_write_png_to_func(append, &text, int(image.width), int(image.height), 3,
                                                 image.values.data(), int(3 * image.width));
  return is_complete != 0 ? std::make_optional(std::move(text)) : std::nullopt;
}

} // namespace Tool
