#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace thing_kin {

/// The processors that the calling thread may use, which may be fewer than there are.
int available_processors() noexcept;

/// How many threads a batch gets: `wanted`, or if that is 0 as many as there are processors to use,
/// but no more than give each at least `grain` items.
int thread_count(int wanted, std::size_t items, std::size_t grain) noexcept;

/// Calls work(first, last) for consecutive ranges that make up [0, items), one a thread. Ranges are
/// cut at multiples of `multiple`. The first exception by order of range is thrown on.
template <typename Work>
void parallel_ranges(std::size_t items, int threads, std::size_t multiple, const Work& work) {
  if (threads <= 1) {
    work(std::size_t{0}, items);
    return;
  }
  const auto count = static_cast<std::size_t>(threads);
  const std::size_t blocks = (items + multiple - 1) / multiple;
  const auto cut = [&](std::size_t i) { return std::min(items, blocks * i / count * multiple); };
  std::vector<std::exception_ptr> errors(count);
  const auto run = [&](std::size_t i) {
    try {
      work(cut(i), cut(i + 1));
    } catch (...) {
      errors[i] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < count; ++i) {
      others.emplace_back(run, i);
    }
    run(0);
  }
  for (const std::exception_ptr& error : errors) {
    if (error) {
      std::rethrow_exception(error);
    }
  }
}

}  // namespace thing_kin
