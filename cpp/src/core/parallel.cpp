#include "thing_kin/core/parallel.hpp"

#include <algorithm>

#ifdef __linux__
#include <sched.h>
#endif

namespace thing_kin {

int available_processors() noexcept {
#ifdef __linux__
  cpu_set_t allowed;  // hardware_concurrency() may count those that this thread is kept from
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
    return std::max(1, CPU_COUNT(&allowed));
  }
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int thread_count(int wanted, std::size_t items, std::size_t grain) noexcept {
  const std::size_t most_paid = items / grain;
  if (most_paid <= 1) {  // before asking the system, which costs more than a small batch
    return 1;
  }
  const int most = wanted > 0 ? wanted : available_processors();
  return static_cast<int>(std::min(static_cast<std::size_t>(most), most_paid));
}

}  // namespace thing_kin
