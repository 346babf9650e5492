#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace musim::tests {

/// Makes a folder the working folder of this process, and that of its shells, while the object is there.
class WorkingFolder {
  public:
    explicit WorkingFolder(const std::filesystem::path& folder) { enter(folder); }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
    ~WorkingFolder() { enter(before_); }

  private:
    static void enter(const std::filesystem::path& folder) {
        std::filesystem::current_path(folder);
        if (setenv("PWD", folder.c_str(), 1) != 0) throw std::runtime_error("the environment has no room");
    }

    std::filesystem::path before_ = std::filesystem::current_path();
};

}  // namespace musim::tests
