#include "thing_kin/core/parallel.hpp"

#include <algorithm>

namespace thing_kin {

int available_processors() noexcept {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int thread_count(int wanted, std::size_t items, std::size_t grain) noexcept {
  const int most = wanted > 0 ? wanted : available_processors();
  return std::max(1, static_cast<int>(std::min(static_cast<std::size_t>(most), items / grain)));
}

}  // namespace thing_kin
