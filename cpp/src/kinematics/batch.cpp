#include "thing_kin/kinematics/batch.hpp"

#include "kernels/arguments.hpp"
#include "thing_kin/core/parallel.hpp"

namespace thing_kin {

namespace {

// A thread costs some tens of microseconds, a row some tens of nanoseconds.
constexpr std::size_t kRowsPerThread = 8192;
constexpr std::size_t kMostLanes = 8;

template <typename Work>
void in_ranges(const JointBatch& batch, const Work& work) {
  const int threads = thread_count(batch.threads, batch.count, kRowsPerThread);
  parallel_ranges(batch.count, threads, kMostLanes, [&](std::size_t first, std::size_t last) {
    work(first, static_cast<long>(last - first));
  });
}

std::size_t dof(const Chain& chain) { return static_cast<std::size_t>(chain.dof()); }

}  // namespace

void forward_kinematics(const Chain& chain, const JointBatch& batch, int frame, PoseFormat format,
                        double* out) {
  const Kernels& run = kernels();
  const auto size = static_cast<std::size_t>(numbers_of(format));
  in_ranges(batch, [&](std::size_t first, long count) {
    run.poses(chain.skeleton(), chain.skeleton_frame(frame), batch.q + first * dof(chain), count,
              format, out + first * size);
  });
}

void geometric_jacobian(const Chain& chain, const JointBatch& batch, const MovingPoint& of,
                        ReferenceFrame reference, double* J) {
  const Kernels& run = kernels();
  const SkeletonFrame frame = skeleton_frame_at(chain, of);
  in_ranges(batch, [&](std::size_t first, long count) {
    run.jacobians(chain.skeleton(), frame, batch.q + first * dof(chain), count, reference, nullptr,
                  J + 6 * dof(chain) * first);
  });
}

void forward_kinematics_and_jacobian(const Chain& chain, const JointBatch& batch, int frame,
                                     ReferenceFrame reference, double* T, double* J) {
  const Kernels& run = kernels();
  in_ranges(batch, [&](std::size_t first, long count) {
    run.jacobians(chain.skeleton(), chain.skeleton_frame(frame), batch.q + first * dof(chain),
                  count, reference, T + 16 * first, J + 6 * dof(chain) * first);
  });
}

}  // namespace thing_kin
