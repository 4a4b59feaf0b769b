// SPDX-License-Identifier: Apache-2.0
#include "output/file_stream.h"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "output/write_error.h"

namespace leafhull {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 20;

}  // namespace

FileBuffer::FileBuffer(int descriptor, std::filesystem::path name)
    : descriptor_(descriptor), name_(std::move(name)), buffer_(kBufferSize) {
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

FileBuffer::int_type FileBuffer::overflow(int_type character) {
  write_buffered();
  return traits_type::eq_int_type(character, traits_type::eof())
             ? traits_type::not_eof(character)
             : sputc(traits_type::to_char_type(character));
}

std::streamsize FileBuffer::xsputn(const char* data, std::streamsize size) {
  if (size >= epptr() - pptr()) write_buffered();
  if (size >= epptr() - pptr()) {
    write_all(data, static_cast<std::size_t>(size));
  } else {
    traits_type::copy(pptr(), data, static_cast<std::size_t>(size));
    pbump(static_cast<int>(size));
  }
  return size;
}

int FileBuffer::sync() {
  write_buffered();
  return 0;
}

FileBuffer::pos_type FileBuffer::seekoff(off_type offset, std::ios_base::seekdir from,
                                         std::ios_base::openmode) {
  write_buffered();
  const int whence = from == std::ios_base::beg   ? SEEK_SET
                     : from == std::ios_base::cur ? SEEK_CUR
                                                  : SEEK_END;
  return ::lseek(descriptor_, offset, whence);
}

FileBuffer::pos_type FileBuffer::seekpos(pos_type position, std::ios_base::openmode mode) {
  return seekoff(position, std::ios_base::beg, mode);
}

void FileBuffer::write_buffered() {
  const std::size_t size = static_cast<std::size_t>(pptr() - pbase());
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  write_all(buffer_.data(), size);
}

void FileBuffer::write_all(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      throw write_error(name_, errno);
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

}  // namespace leafhull
