#include "app/serve/messages/jpeg.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
// After cstdio, which it needs and does not include.
#include <jpeglib.h>

namespace ostium::app {

std::string jpeg_of(const fluoro::Picture& picture, int quality) {
  if (picture.grey.empty()) return {};
  jpeg_error_mgr errors;
  jpeg_compress_struct to;
  to.err = jpeg_std_error(&errors);  // sizes are ours and memory is the only trouble: it ends the program
  jpeg_create_compress(&to);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&to, &bytes, &size);
  to.image_width = static_cast<JDIMENSION>(picture.width), to.image_height = static_cast<JDIMENSION>(picture.height);
  to.input_components = 1, to.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&to);
  jpeg_set_quality(&to, quality, TRUE);
  jpeg_start_compress(&to, TRUE);
  while (to.next_scanline < to.image_height) {
    auto* row = const_cast<JSAMPROW>(picture.grey.data() + std::size_t{to.next_scanline} * to.image_width);
    jpeg_write_scanlines(&to, &row, 1);
  }
  jpeg_finish_compress(&to);
  std::string out(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&to);
  std::free(bytes);
  return out;
}

}  // namespace ostium::app
