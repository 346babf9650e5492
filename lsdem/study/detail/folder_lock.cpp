#include "lsdem/study/detail/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "records/error.hpp"

namespace musim::lsdem::study::detail {

FolderLock::FolderLock(const std::filesystem::path& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(descriptor_);
    throw records::WriteError(fmt::format(
        "{}: another musim is working in this directory; wait for it to end, or choose another output directory", directory.string()));
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<bool> is_locked(const std::filesystem::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return false;
    // a shared lock is refused while one process has it all; it goes with the descriptor
    const bool free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    const bool told = free || errno == EWOULDBLOCK;
    ::close(descriptor);
    return told ? std::optional(!free) : std::nullopt;
}

}  // namespace musim::lsdem::study::detail
