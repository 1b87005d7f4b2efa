// What control loops call must not touch the heap: malloc itself is counted here.

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "random_chain.hpp"
#include "scan_room.hpp"
#include "thing_kin/core/simd.hpp"
#include "thing_kin/estimation/end_effector.hpp"
#include "thing_kin/estimation/extended_kalman.hpp"
#include "thing_kin/estimation/kalman.hpp"
#include "thing_kin/estimation/pose_belief.hpp"
#include "thing_kin/estimation/unscented_kalman.hpp"
#include "thing_kin/inverse/numeric_ik.hpp"
#include "thing_kin/inverse/task_priority.hpp"
#include "thing_kin/kinematics/acceleration.hpp"
#include "thing_kin/kinematics/analytic_jacobian.hpp"
#include "thing_kin/kinematics/batch.hpp"
#include "thing_kin/kinematics/clearance.hpp"
#include "thing_kin/kinematics/jacobian_dot.hpp"
#include "thing_kin/kinematics/manipulability.hpp"
#include "thing_kin/linalg/null_space.hpp"
#include "thing_kin/linalg/pseudoinverse.hpp"
#include "thing_kin/model/robots.hpp"
#include "thing_kin/odometry/laser_odometry.hpp"
#include "thing_kin/odometry/mecanum.hpp"
#include "thing_kin/planning/path_follower.hpp"

namespace {
std::atomic<int> allocations{0};
}

// The sanitizers bring their own malloc, which must stay.
#if !defined(__SANITIZE_ADDRESS__)
extern "C" {
void* __libc_malloc(std::size_t size);                     // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT
void* __libc_realloc(void* block, std::size_t size);       // NOLINT

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
}
#endif

namespace thing_kin {
namespace {

template <typename Function>
int allocations_in(Function function) {
  const int before = allocations;
  function();
  return allocations - before;
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(NoHeap, TheCounterCounts) {
  // Where it goes must not be known, or the compiler leaves the pair of new and delete out.
  std::unique_ptr<Svd> svd;
  EXPECT_GE(allocations_in([&] { svd = std::make_unique<Svd>(); }), 1);
  EXPECT_GE(allocations_in([] { Eigen::MatrixXd::Random(7, 7).eval(); }), 1);
}
#endif

TEST(NoHeap, Kinematics) {
  const Chain robot = robots::thing();
  test::Generator rng(1);
  const Eigen::VectorXd q = test::random_vector(rng, robot.dof());
  EXPECT_EQ(allocations_in([&] {
              Posture posture;
              Jacobian J;
              Hessian H;
              place_joints(robot, q.data(), posture);
              geometric_jacobian(robot, posture, robot.tool(), ReferenceFrame::kBody, J);
              geometric_hessian(robot, posture, robot.tool(), ReferenceFrame::kWorldAligned, H);
              const Dexterity dexterity(robot, posture, robot.tool());
              dexterity.manipulability_gradient(H);
              dexterity.dexterity_gradient(H);
              task_vector(robot, q.data());
            }),
            0);
}

TEST(NoHeap, Clearances) {
  const Chain robot = robots::thing();
  LinkSpheres shape = spheres_along_links(robot, 0.1, 0.1);
  shape.pairs = self_collision_pairs(robot, shape.spheres);
  const Clearances clearances(
      robot, shape,
      {Disc{{1, 1}, 0.3}, Sphere{{1, 0, 1}, 0.1}, Capsule{{1, 0, 0}, {1, 0, 1}, 0.1},
       Box{{}, {0.1, 0.1, 0.1}}, HalfSpace{}});
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(9, -1.0, 1.0);
  double sum = 0.0;
  EXPECT_EQ(allocations_in([&] {
              Posture posture;
              JointVector gradient;
              SmallMatrix H = SmallMatrix::Zero(9, 9);
              place_joints(robot, q.data(), posture);
              for (int i = 0; i < clearances.size(); ++i) {
                sum += clearances.value(posture, q.data(), i);
                sum -= clearances.gradient(posture, q.data(), i, gradient);
                clearances.add_hessian(posture, q.data(), i, 1.0, H);
              }
            }),
            0);
  EXPECT_NEAR(sum, 0.0, 1e-9);
}

TEST(NoHeap, PoseBelief) {
  PoseBelief belief(Pose2(1.0, 2.0, 3.0), Eigen::Matrix3d::Identity());
  const PlanarStep step{Twist2(0.1, 0.0, 0.2), Eigen::Matrix3d::Identity() * 1e-3,
                        Eigen::Matrix3d::Identity() * 1e-4};
  const PoseMeasurement measured{Pose2(1.0, 2.0, -3.0), Eigen::Matrix3d::Identity(), 5, 16.0};
  EXPECT_EQ(allocations_in([&] {
              belief.predict(step, PoseFilter::kExtended);
              belief.predict(step, PoseFilter::kUnscented);
              EXPECT_TRUE(belief.update(measured).accepted);
            }),
            0);
}

TEST(NoHeap, Filters) {
  const MotionModelPtr motion = constant_twist();
  const MeasurementModelPtr bearing = range_bearing(Eigen::Vector2d(5.0, 3.0));
  StateVector z(2);
  z << 5.5, 0.4;
  const StateVector x = StateVector::Zero(6);
  const StateMatrix P = 0.01 * StateMatrix::Identity(6, 6);
  const StateMatrix R = 0.1 * StateMatrix::Identity(2, 2);
  const ModelMatrix F = ModelMatrix::Identity(6, 6);
  const ModelMatrix H = ModelMatrix::Identity(2, 6);
  const AngleSet& angles = motion->angles();
  KalmanFilter linear(x, P);
  ExtendedKalmanFilter extended(x, P, angles);
  UnscentedKalmanFilter unscented(x, P, {}, angles);
  UnscentedKalmanFilter root(x, P, {.square_root = true}, angles);
  EXPECT_EQ(allocations_in([&] {
              EXPECT_EQ(linear.predict(F, P), FilterStatus::kOk);
              EXPECT_EQ(linear.update(z, H, R), FilterStatus::kOk);
              EXPECT_EQ(extended.predict(*motion, 0.1), FilterStatus::kOk);
              EXPECT_EQ(extended.update(z, *bearing, R), FilterStatus::kOk);
              for (UnscentedKalmanFilter* filter : {&unscented, &root}) {
                EXPECT_EQ(filter->predict(*motion, 0.1), FilterStatus::kOk);
                EXPECT_EQ(filter->update(z, *bearing, R), FilterStatus::kOk);
              }
            }),
            0);
}

// Misuse is found before the loop: what a control loop calls throws nothing and allocates nothing,
// at every level of instructions, a huge angle included.
TEST(NoHeap, ForwardKinematicsAndJacobianAtEveryLevel) {
  static_assert(
      noexcept(place_joints(std::declval<const Chain&>(), nullptr, std::declval<Posture&>())));
  static_assert(noexcept(forward_kinematics(std::declval<const Chain&>(), nullptr, 0)));
  static_assert(noexcept(frame_pose(std::declval<const Chain&>(), std::declval<Posture&>(), 0)));
  static_assert(noexcept(geometric_jacobian(std::declval<const Chain&>(), std::declval<Posture&>(),
                                            std::declval<const MovingPoint&>(),
                                            ReferenceFrame::kBody, std::declval<Jacobian&>())));
  const Chain robot = robots::thing();
  test::Generator rng(5);
  Eigen::VectorXd q = test::random_vector(rng, robot.dof());
  q[2] = 1e9;
  const SimdLevel best = best_simd_level();
  double sum = 0.0;
  for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (level > best) {
      continue;
    }
    use_simd_level(level);
    EXPECT_EQ(allocations_in([&] {
                Posture posture;
                Jacobian J;
                place_joints(robot, q.data(), posture);
                for (const auto reference : {ReferenceFrame::kWorldAligned, ReferenceFrame::kBody,
                                             ReferenceFrame::kWorld}) {
                  geometric_jacobian(robot, posture, robot.tool(), reference, J);
                  sum += J.sum();
                }
                sum += frame_pose(robot, posture, robot.tool()).translation.sum();
                sum += forward_kinematics(robot, q.data(), robot.tool()).translation.sum();
              }),
              0)
        << to_string(level);
  }
  use_simd_level(best);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(NoHeap, ABatchOnOneThread) {
  const Chain robot = robots::thing();
  test::Generator rng(6);
  const Eigen::VectorXd q = test::random_vector(rng, 100 * robot.dof());
  std::vector<double> T(100 * 16);
  std::vector<double> J(100 * 6 * 9);
  EXPECT_EQ(allocations_in([&] {
              const JointBatch batch{q.data(), 100, 1};
              forward_kinematics(robot, batch, robot.tool(), PoseFormat::kMatrix, T.data());
              geometric_jacobian(robot, batch, robot.tool(), ReferenceFrame::kBody, J.data());
            }),
            0);
}

TEST(NoHeap, DifferentialKinematics) {
  const Chain robot = robots::thing();
  test::Generator rng(4);
  const Eigen::VectorXd q = test::random_vector(rng, robot.dof());
  const Eigen::VectorXd qd = test::random_vector(rng, robot.dof());
  const Eigen::VectorXd qdd = test::random_vector(rng, robot.dof());
  const MovingPoint of(robot.tool(), Eigen::Vector3d(0.1, 0.2, 0.3));
  Vector6 sum = Vector6::Zero();
  EXPECT_EQ(allocations_in([&] {
              Posture posture;
              Jacobian dJ;
              AnalyticJacobian A;
              place_joints(robot, q.data(), posture);
              for (const auto reference :
                   {ReferenceFrame::kWorldAligned, ReferenceFrame::kBody, ReferenceFrame::kWorld}) {
                geometric_jacobian_dot(robot, posture, of, reference, qd.data(), dJ);
                sum += frame_velocity(robot, posture, of, reference, qd.data());
                sum += frame_drift(robot, posture, of, reference, qd.data());
                sum += frame_acceleration(robot, posture, of, reference, AccelerationKind::kSpatial,
                                          qd.data(), qdd.data());
              }
              for (const auto orientation : {Orientation::kQuaternion, Orientation::kRpy}) {
                task_vector(robot, q.data(), orientation);
                EXPECT_TRUE(analytic_jacobian(robot, posture, of, orientation, A));
                EXPECT_TRUE(task_jacobian(robot, posture, orientation, A));
              }
            }),
            0);
  EXPECT_TRUE(sum.allFinite());
}

TEST(NoHeap, LinearAlgebra) {
  test::Generator rng(2);
  for (const auto& [rows, cols] : {std::pair{6, 9}, {9, 6}, {3, 9}, {32, 32}}) {
    const SmallMatrix A =
        SmallMatrix::NullaryExpr(rows, cols, [&] { return test::uniform(rng, -1, 1); });
    EXPECT_EQ(allocations_in([&, m = rows] {
                Svd svd;
                decompose(A, svd);
                SingularValueFilter(0.01, 10.0).apply(svd);
                pseudoinverse(svd, damped_gains(svd, 1e-3));
                exact_pseudoinverse(A);
                selectively_damped_step(svd, RowBlocks::whole(m), SmallVector::Ones(m), 0.5);
                null_space_projector(A);
              }),
              0);
  }
}

TEST(NoHeap, TaskPriorityInEverySchemeAndInverse) {
  const Chain robot = robots::thing();
  test::Generator rng(3);
  const Eigen::VectorXd q = test::random_vector(rng, 9);
  const Eigen::VectorXd goal = test::random_vector(rng, 9);
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T =
      forward_kinematics(robot, goal.data(), robot.tool()).matrix();
  const Eigen::Vector3d base(0.1, 0.2, 0.3);
  const std::array<const double*, 2> targets = {T.data(), base.data()};
  const Eigen::VectorXd z = test::random_vector(rng, 9);
  auto step = std::make_unique<TaskPriorityStep>();
  for (const Scheme scheme : {Scheme::kNakamura, Scheme::kSiciliano, Scheme::kChiaverini}) {
    for (const DifferentialInverse& inverse :
         {DifferentialInverse(Exact()), DifferentialInverse(Damped(1e-3)),
          DifferentialInverse(SelectivelyDamped())}) {
      for (const std::optional<SingularValueFilter>& filter :
           {std::optional<SingularValueFilter>(), std::optional(SingularValueFilter(0.01, 10.0))}) {
        const TaskPriorityOptions options{scheme, inverse, filter, JointVector::Constant(9, 0.1)};
        const TaskPriority solver(
            robot, {std::make_shared<PoseTask>(), std::make_shared<BaseTask>()}, options);
        std::array<SmallVector, 2> sigma;
        EXPECT_EQ(allocations_in([&] {
                    solver.solve(q.data(), targets, z.data(), *step);
                    solver.singular_values(q.data(), targets, sigma);
                  }),
                  0);
      }
    }
  }
}

TEST(NoHeap, NumericIk) {
  const Chain robot = robots::thing();
  test::Generator rng(9);
  const JointVector seed = test::random_vector(rng, 9);
  const JointVector goal = seed + test::random_vector(rng, 9, 0.3);
  SE3 target = forward_kinematics(robot, goal.data(), robot.tool());
  for (const double far : {0.0, 30.0}) {
    target.translation.z() += far;
    for (const IkObjective objective : {IkObjective::kNone, IkObjective::kSeed,
                                        IkObjective::kLimits, IkObjective::kManipulability}) {
      for (const bool nearest : {false, true}) {
        IkOptions options;
        options.objective = objective;
        options.nearest = nearest;
        const NumericIk solver(robot, robot.tool(), options);
        IkResult result;
        EXPECT_EQ(allocations_in([&] { result = solver.solve(target, seed.data()); }), 0);
        EXPECT_EQ(result.success(), far == 0.0);
      }
    }
  }
}

TEST(NoHeap, TaskPriorityWithinLimits) {
  const Chain robot = robots::thing();
  test::Generator rng(7);
  const Eigen::VectorXd q = test::random_vector(rng, 9, 0.9);
  const Eigen::VectorXd goal = test::random_vector(rng, 9);
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T =
      forward_kinematics(robot, goal.data(), robot.tool()).matrix();
  const Eigen::Vector3d point(0.1, 0.2, 0.3);
  const std::array<const double*, 6> targets = {point.data(), T.data(),     point.data(),
                                                point.data(), point.data(), nullptr};
  const Eigen::VectorXd z = test::random_vector(rng, 9);
  auto step = std::make_unique<LimitedStep>();
  const JointVector one = JointVector::Ones(9);
  const JointVector previous = 1e-3 * one;
  for (const std::optional<SingularValueFilter>& filter :
       {std::optional<SingularValueFilter>(), std::optional(SingularValueFilter(0.01, 10.0))}) {
    TaskPriorityOptions options =
        TaskPriorityOptions::limited(LimitOptions(0.01, WheelLimits(0.1, 0.5, 5.0)));
    options.filter = filter;
    options.step_limit = 0.1 * one;
    const TaskPriority solver(
        robot,
        {std::make_shared<BaseObstacleTask>(0.5), std::make_shared<PoseTask>(),
         std::make_shared<FieldOfViewTask>(0.3), std::make_shared<DistanceTask>(0.1, 0.2),
         std::make_shared<BaseTask>(), std::make_shared<JointRangeTask>(-one, one)},
        options);
    JointVector dq;
    EXPECT_EQ(allocations_in([&] {
                solver.solve_limited(q.data(), targets, z.data(), previous.data(), *step);
                solver.step_limited(q.data(), targets, nullptr, nullptr, dq);
              }),
              0);
    EXPECT_GT(step->iterations, 0);
    EXPECT_TRUE(dq.allFinite());
  }
}

TEST(NoHeap, OdometryAndTheHandOnIt) {
  const Chain robot = robots::thing();
  const MecanumOdometry wheels(0.0759, 0.6);
  ArmUncertainty uncertainty;
  uncertainty.joints = 1e-6 * SmallMatrix::Identity(6, 6);
  const JointVector q = JointVector::Constant(6, 0.3);
  PlanarEstimate base;
  EndEffector hand;
  EXPECT_EQ(allocations_in([&] {
              for (int k = 0; k < 10; ++k) {
                const Eigen::Vector4d w = wheels.wheel_speeds({0.5, 0.1, 0.2});
                move(base, wheels.twist(w) * 0.02, default_twist_covariance() * 0.0004);
                hand = end_effector(robot, q.data(), base, uncertainty, robot.tool());
              }
            }),
            0);
  EXPECT_GT(hand.covariance.trace(), 0.0);
}

TEST(NoHeap, LaserOdometryInAKnownRoom) {
  const Scanner scanner{.n = 1081, .range_max = 30.0, .scan_time = 0.02};  // thinned by matches
  constexpr int kLap = 40;
  std::vector<std::vector<double>> lap;
  std::vector<Pose2> poses;
  for (int k = 0; k <= kLap; ++k) {
    const double phase = 2.0 * std::numbers::pi * k / kLap;
    poses.emplace_back(0.4 * std::sin(phase), 0.3 * std::cos(phase), 0.5 * std::sin(phase));
    lap.push_back(test::ranges_in(test::furnished_room(), scanner, poses.back(), 0.01,
                                  static_cast<unsigned>(k)));
  }
  LaserOdometry lidar(scanner, {});
  int at = 0;
  int keyframes = 0;
  int lost = 0;
  const auto drive = [&](int scans) {
    for (int end = at + scans; at < end; ++at) {
      const auto k = static_cast<std::size_t>(at % kLap);
      const PlanarEstimate moved{.pose = between(poses[k > 0 ? k - 1 : kLap - 1], poses[k]),
                                 .covariance = 1e-4 * Eigen::Matrix3d::Identity()};
      const LaserStep step = lidar.add(lap[k], 0.1 * at, moved, ScanMotion{});
      keyframes += step.keyframe ? 1 : 0;
      lost += step.status == LaserStatus::kLost ? 1 : 0;
    }
  };
  drive(30 * kLap);  // until as much is forgotten as is new
  const int before = keyframes;
  EXPECT_EQ(allocations_in([&] { drive(2 * kLap); }), 0);
  EXPECT_GT(keyframes, before + 4);  // what a scan adds to the map was known
  EXPECT_EQ(lost, 0);
}

TEST(NoHeap, PathFollower) {
  const Chain robot = robots::thing();
  JointVector q(9);
  q << 0.0, -1.2, 1.4, -0.6, 1.2, 0.0, 0.0, 0.0, 0.0;
  LinkSpheres shape = spheres_along_links(robot, 0.08, 0.2);
  shape.pairs = self_collision_pairs(robot, shape.spheres);
  PathProblem problem(robot, robot.tool(), {Disc{{0.4, 0.3}, 0.28}, Sphere{{1.0, 0.5, 0.8}, 0.2}},
                      shape);
  problem.has_base_path = true;
  problem.base_radius = 0.3;
  problem.max_joint_step.setConstant(0.2);
  problem.dexterity_weight = 1e-3;
  PathFollower follower(std::move(problem), 10, q);
  PathGoal goal;
  goal.pose = forward_kinematics(robot, q.data(), robot.tool());
  bool every = true;
  EXPECT_EQ(allocations_in([&] {
              FollowerStep step;
              for (int k = 0; k < 40; ++k) {
                goal.pose.translation[0] += 0.02;
                goal.base[0] += 0.02;
                every = follower.push(goal) && every;
                every = (k < 9 || follower.step(step)) && every;
              }
            }),
            0);
  EXPECT_TRUE(every);
}

}  // namespace
}  // namespace thing_kin
