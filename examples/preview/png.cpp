// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstring>
#include <fstream>

#include "leafhull/error.h"
#include "render.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace leafhull::preview {

void write_png(const Picture& picture, const std::filesystem::path& path) {
  std::filesystem::path unfinished = path;
  unfinished += ".unfinished";
  const auto fail = [&](const char* why) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw Error(ErrorCode::output, path.string() + ": cannot be written (" + why + ")",
                "Choose a folder that exists, may be written to and has space.");
  };

  if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path)) {
    fail("it is not a regular file");
  }
  std::ofstream file(unfinished, std::ios::binary);
  if (!file) fail(std::strerror(errno));
  const auto append = [](void* context, void* bytes, int count) {
    static_cast<std::ofstream*>(context)->write(static_cast<const char*>(bytes), count);
  };
  const int encoded = stbi_write_png_to_func(append, &file, picture.width, picture.height, 3,
                                             picture.rgb.data(), 3 * picture.width);
  file.close();
  if (!encoded || !file) fail(std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  if (error) fail(error.message().c_str());
}

}  // namespace leafhull::preview
