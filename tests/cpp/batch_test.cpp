// Batches against single poses: every level of instructions, every number of rows and threads.

#include "thing_kin/kinematics/batch.hpp"

#ifdef __linux__
#include <sched.h>
#endif

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "every_level.hpp"
#include "random_chain.hpp"
#include "thing_kin/core/parallel.hpp"
#include "thing_kin/lie/so3.hpp"

namespace thing_kin {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Twelve products with entries up to a few meters; prismatic joints of 3 m.
constexpr double kTolerance = 1e-12;

class EveryLevel : public test::EveryLevel {};

INSTANTIATE_TEST_SUITE_P(Batch, EveryLevel, test::every_level(),
                         [](const auto& level) { return to_string(level.param); });

// The joints as the description has them, one matrix after the other.
SE3 by_matrices(const Chain& chain, const double* q, int frame) {
  SE3 T;
  std::size_t joint = 0;
  for (int i = 0; i < frame; ++i) {
    const Segment& segment = chain.description().segments[static_cast<std::size_t>(i)];
    SE3 motion;
    if (segment.type != JointType::kFixed) {
      const double value = q[chain.description().order[joint++]];
      if (segment.type == JointType::kPrismatic) {
        motion.translation.z() = value;
      } else {
        motion.rotation = so3_exp({0.0, 0.0, value});
      }
    }
    T = T * segment.before * motion * segment.after;
  }
  return T;
}

TEST_P(EveryLevel, PosesAreThoseOfTheMatrices) {
  test::Generator rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Chain chain = test::random_chain(rng);
    const Eigen::VectorXd q = test::random_vector(rng, chain.dof(), 10.0);
    Posture posture;
    place_joints(chain, q.data(), posture);
    for (int frame = 0; frame <= chain.tool(); ++frame) {
      const SE3 expected = by_matrices(chain, q.data(), frame);
      for (const SE3& T :
           {forward_kinematics(chain, q.data(), frame), frame_pose(chain, posture, frame)}) {
        EXPECT_TRUE(T.matrix().isApprox(expected.matrix(), kTolerance));
      }
    }
  }
}

TEST_P(EveryLevel, RowsAreSinglePoses) {
  test::Generator rng(2);
  for (const std::size_t rows : {1U, 2U, 5U, 8U, 9U, 67U}) {
    const Chain chain = test::random_chain(rng);
    const int n = chain.dof();
    const Eigen::VectorXd q = test::random_vector(rng, static_cast<Eigen::Index>(rows) * n);
    std::vector<double> T(rows * 16);
    std::vector<double> p(rows * 7);
    const JointBatch batch{q.data(), rows, 0};
    forward_kinematics(chain, batch, chain.tool(), PoseFormat::kMatrix, T.data());
    forward_kinematics(chain, batch, chain.tool(), PoseFormat::kPositionQuaternion, p.data());
    for (std::size_t i = 0; i < rows; ++i) {
      const double* one = q.data() + i * static_cast<std::size_t>(n);
      const SE3 expected = forward_kinematics(chain, one, chain.tool());
      EXPECT_TRUE((Eigen::Map<const RowMajor>(T.data() + 16 * i, 4, 4) - expected.matrix())
                      .isZero(kTolerance));
      EXPECT_TRUE((Eigen::Map<const Eigen::Vector3d>(p.data() + 7 * i) - expected.translation)
                      .isZero(kTolerance));
      const Eigen::Vector4d quaternion = quaternion_from_rotation(expected.rotation);
      EXPECT_TRUE((Eigen::Map<const Eigen::Vector4d>(p.data() + 7 * i + 3) - quaternion)
                      .isZero(kTolerance));
    }
  }
}

TEST_P(EveryLevel, JacobiansAreThoseOfSinglePosturesInEveryFrame) {
  test::Generator rng(4);
  for (const std::size_t rows : {1U, 2U, 5U, 8U, 9U, 67U}) {
    const Chain chain = test::random_chain(rng);
    const auto size = 6 * static_cast<std::size_t>(chain.dof());
    const Eigen::MatrixXd q =
        test::random_vector(rng, static_cast<Eigen::Index>(rows) * chain.dof())
            .reshaped(chain.dof(), static_cast<Eigen::Index>(rows));
    std::vector<double> J(rows * size);
    const MovingPoint point(chain.tool(), Eigen::Vector3d(0.3, -0.2, 0.1));
    for (const auto reference :
         {ReferenceFrame::kWorldAligned, ReferenceFrame::kBody, ReferenceFrame::kWorld}) {
      geometric_jacobian(chain, {q.data(), rows, 0}, point, reference, J.data());
      for (std::size_t i = 0; i < rows; ++i) {
        Posture posture;
        Jacobian single;
        place_joints(chain, q.col(static_cast<Eigen::Index>(i)).data(), posture);
        geometric_jacobian(chain, posture, point, reference, single);
        const Eigen::Map<const RowMajor> row(J.data() + i * size, 6, chain.dof());
        EXPECT_TRUE((row - single).isZero(kTolerance));
      }
    }
  }
}

TEST(Batch, ThreadsChangeNothing) {
  test::Generator rng(3);
  const Chain chain = test::random_chain(rng);
  constexpr std::size_t kRows = 50'001;
  const Eigen::VectorXd q =
      test::random_vector(rng, static_cast<Eigen::Index>(kRows) * chain.dof());
  std::vector<double> one(kRows * 16);
  forward_kinematics(chain, {q.data(), kRows, 1}, chain.tool(), PoseFormat::kMatrix, one.data());
  for (const int threads : {0, 2, 3, 5}) {
    std::vector<double> several(kRows * 16);
    forward_kinematics(chain, {q.data(), kRows, threads}, chain.tool(), PoseFormat::kMatrix,
                       several.data());
    EXPECT_EQ(one, several) << threads;
  }
}

TEST(Parallel, RangesCoverAllOnceAndAreCutAtMultiples) {
  for (const std::size_t items : {0U, 1U, 7U, 8U, 100U}) {
    for (const int threads : {1, 2, 3, 16}) {
      std::vector<int> visits(items, 0);
      parallel_ranges(items, threads, 8, [&](std::size_t first, std::size_t last) {
        EXPECT_TRUE(first % 8 == 0 || first == items);
        for (std::size_t i = first; i < last; ++i) {
          ++visits[i];
        }
      });
      EXPECT_EQ(visits, std::vector<int>(items, 1)) << items << " on " << threads;
    }
  }
}

TEST(Parallel, TheFirstExceptionByOrderComesThrough) {
  const auto fail = [](std::size_t first, std::size_t) {
    if (first > 0) {
      throw std::runtime_error(std::to_string(first));
    }
  };
  try {
    parallel_ranges(30, 3, 1, fail);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "10");
  }
}

TEST(Parallel, ThreadsArePaidFor) {
  EXPECT_EQ(thread_count(4, 100, 100), 1);
  EXPECT_EQ(thread_count(4, 0, 100), 1);
  EXPECT_EQ(thread_count(4, 300, 100), 3);
  EXPECT_EQ(thread_count(4, 3000, 100), 4);
  EXPECT_EQ(thread_count(0, 1'000'000, 1), available_processors());
}

#ifdef __linux__
// As taskset, a container or a batch system does it.
TEST(Parallel, ProcessorsThisThreadIsKeptFromAreNotCounted) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  const int all = available_processors();
  EXPECT_EQ(all, CPU_COUNT(&before));
  std::size_t first = 0;
  while (!CPU_ISSET(first, &before)) {
    ++first;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(available_processors(), 1);
  EXPECT_EQ(thread_count(0, 1'000'000, 1), 1);
  EXPECT_EQ(thread_count(3, 1'000'000, 1), 3);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(available_processors(), all);
}
#endif

}  // namespace
}  // namespace thing_kin
