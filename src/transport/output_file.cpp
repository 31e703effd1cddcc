#include "transport/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "messages/input_error.h"

namespace whirl_twin {

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wb")) {
  if (file_ == nullptr) {
    fail();
  }
}

OutputFile::~OutputFile() {
  std::fclose(file_);
}

void OutputFile::write(const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, file_) != size) {
    fail();
  }
  offset_ += size;
}

void OutputFile::rewrite(std::uint64_t offset, const LittleEndian& bytes) {
  if (std::fseek(file_, static_cast<long>(offset), SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size() ||
      std::fseek(file_, 0, SEEK_END) != 0) {
    fail();
  }
}

void OutputFile::flush() {
  if (std::fflush(file_) != 0) {
    fail();
  }
}

void OutputFile::fail() const {
  throw RunFailure(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

}  // namespace whirl_twin
