// SPDX-License-Identifier: MIT
#include "Png.h"

#include <png.h>

#include "allpairs/Error.h"

namespace allpairs::view {

std::string encodePng(const Raster& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width());
  image.height = static_cast<png_uint_32>(picture.height());
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;                      // of flat colours: without filters a third of the time
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);  // to ask for the size itself is to compress twice
  std::string result(size, '\0');
  if (png_image_write_to_memory(&image, result.data(), &size, 0, picture.pixels().data(), 0, nullptr) == 0) {
    throw Error(image.message);
  }
  result.resize(size);
  return result;
}

}  // namespace allpairs::view
