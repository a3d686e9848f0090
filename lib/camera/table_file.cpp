#include "camera/table_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace ringhook {

TableFile::TableFile(std::filesystem::path path, const std::string& header)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) {
    fail(errno);
  }
  try {
    append(header);
  } catch (const Error&) {
    ::close(std::exchange(descriptor_, -1));
    throw;
  }
}

TableFile::~TableFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void TableFile::append(const std::string& lines) {
  std::size_t written = 0;
  while (written < lines.size()) {
    const ssize_t count = ::write(descriptor_, lines.data() + written, lines.size() - written);
    if (count < 0 && errno != EINTR) {
      const int error = errno;
      if (::ftruncate(descriptor_, size_) == 0) {
        ::lseek(descriptor_, size_, SEEK_SET);
      }
      fail(error);
    }
    written += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  size_ += static_cast<std::int64_t>(lines.size());
}

void TableFile::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor < 0) {
    return;
  }
  // Devices and some network file systems cannot wait for the disk; that is no failure.
  const bool late = ::fdatasync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP;
  const int error = errno;
  if (::close(descriptor) != 0) {
    fail(errno);
  }
  if (late) {
    fail(error);
  }
}

void TableFile::fail(int error) const {
  throw Error("writing " + path_.string() + " failed: " + std::generic_category().message(error));
}

}  // namespace ringhook
