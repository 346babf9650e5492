#include "lsdem/results/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "records/error.hpp"

namespace musim::lsdem::detail {

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

FileLock::FileLock(const std::filesystem::path& file) : path_(file.parent_path() / fmt::format(".{}.lock", file.filename().string())) {
    while (true) {
        descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            throw records::WriteError(
                fmt::format("{}: cannot be made ({}); choose another folder", file.string(), std::generic_category().message(errno)));
        }
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(descriptor_);
            throw records::WriteError(fmt::format("{}: another musim is making it; wait for it to end", file.string()));
        }
        // the one that held it may have removed the file just before
        struct stat held {
        }, now{};
        if (::fstat(descriptor_, &held) == 0 && ::stat(path_.c_str(), &now) == 0 && held.st_ino == now.st_ino) return;
        ::close(descriptor_);
    }
}

FileLock::~FileLock() {
    if (descriptor_ < 0) return;
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

std::optional<bool> is_locked(const std::filesystem::path& directory) {
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return false;
    // a shared lock is refused while one process has it all; it goes with the descriptor
    const bool free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    const bool given = free || errno == EWOULDBLOCK;
    ::close(descriptor);
    return given ? std::optional(!free) : std::nullopt;
}

}  // namespace musim::lsdem::detail
