#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace musim::lsdem {

/// A fixed set of threads that run one function at a time, each on its own index, and meet again before `run` returns. Waiting threads spin
/// for a moment, then sleep. `run` neither allocates nor locks. The caller's thread is member 0.
class ThreadTeam {
  public:
    /// `threads` ≥ 1, the caller's included.
    explicit ThreadTeam(int threads);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return static_cast<int>(workers_.size()) + 1; }

    /// Calls function(index) once on every thread. The function must not throw.
    template <class Function>
    void run(const Function& function) {
        task_ = [](const void* f, int index) { (*static_cast<const Function*>(f))(index); };
        context_ = &function;
        start();
        function(0);
        wait_for_all();
    }

  private:
    void work(int index);
    void start();
    void wait_for_all();

    void (*task_)(const void*, int) = nullptr;
    const void* context_ = nullptr;
    std::atomic<std::uint32_t> round_{0};
    std::atomic<int> busy_{0};
    std::atomic<bool> stop_{false};
    std::vector<std::thread> workers_;
};

}  // namespace musim::lsdem
