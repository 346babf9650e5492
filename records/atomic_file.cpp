#include "records/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

namespace musim::records {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what, int error) {
    throw WriteError(fmt::format("{}: {} ({}); check space and permissions", path.string(), what, std::generic_category().message(error)));
}

/// An open file descriptor, closed on destruction.
class OutputFile {
  public:
    OutputFile(const std::filesystem::path& path, int flags) : descriptor_(::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) {}
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    bool is_open() const { return descriptor_ >= 0; }

    /// All bytes, or false with errno set.
    bool write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return true;
    }

    /// To the disk, so that a full one is noticed before the file takes its name.
    bool flush() { return ::fsync(descriptor_) == 0; }

    bool close() {
        const int descriptor = descriptor_;
        descriptor_ = -1;
        return ::close(descriptor) == 0;
    }

  private:
    int descriptor_;
};

void write_directly(const std::filesystem::path& path, std::string_view bytes) {
    OutputFile file(path, 0);
    if (!file.is_open()) fail(path, "cannot be opened for writing", errno);
    if (!file.write(bytes) || !file.close()) fail(path, "cannot be written", errno);
}

/// Says why no file can be made in the folder of `path`.
[[noreturn]] void fail_in_folder(const std::filesystem::path& path, int error) {
    std::error_code unused;
    const std::filesystem::path folder = path.parent_path();
    if (error == ENOENT && !std::filesystem::exists(folder, unused)) {
        throw WriteError(fmt::format("{}: cannot be created (there is no folder {}); create the folder", path.string(), folder.string()));
    }
    fail(path, "cannot be created in its folder", error);
}

// a name nobody else uses: process and count
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
    static std::atomic<unsigned> count{0};
    return target.parent_path() / fmt::format(".{}.{}.{}.tmp", target.filename().string(), ::getpid(), ++count);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) fail(path, "cannot be written", EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        write_directly(path, bytes);
        return;
    }

    const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
    const std::filesystem::path temporary = temporary_beside(error ? path : target);
    OutputFile file(temporary, O_CREAT | O_EXCL);
    if (!file.is_open()) fail_in_folder(path, errno);
    if (!file.write(bytes) || !file.flush() || !file.close() || ::rename(temporary.c_str(), (error ? path : target).c_str()) != 0) {
        const int reason = errno;
        ::unlink(temporary.c_str());
        fail(path, "cannot be written, nothing is left of it", reason);
    }
}

}  // namespace musim::records
