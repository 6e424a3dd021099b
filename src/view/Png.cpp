// SPDX-License-Identifier: MIT
#include "Png.h"

#include <png.h>

#include <vector>

#include "allpairs/Error.h"

namespace allpairs::view {

std::string encodePng(const Raster& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.width() * picture.height() * 3);
  for (std::size_t y = 0; y < picture.height(); ++y) {
    for (std::size_t x = 0; x < picture.width(); ++x) {
      const Colour colour = picture.at(x, y);
      bytes.insert(bytes.end(), colour.begin(), colour.end());
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;                      // of flat colours: without filters a third of the time
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);  // to ask for the size itself is to compress twice
  std::string result(size, '\0');
  if (png_image_write_to_memory(&image, result.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
    throw Error(image.message);
  }
  result.resize(size);
  return result;
}

}  // namespace allpairs::view
