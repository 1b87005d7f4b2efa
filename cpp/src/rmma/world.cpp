#include "thing_kin/rmma/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "thing_kin/core/error.hpp"
#include "thing_kin/core/random.hpp"

namespace thing_kin {

namespace {

using Eigen::Vector2d;

constexpr double kNodeSpacing = 0.01;  // m: short against every correlation length

Vector2d draw_pair(RandomStream& random, double deviation) {
  const double x = random.normal();
  return deviation * Vector2d(x, random.normal());
}

/// What a process of correlation `length` keeps over one node, and what is new then.
struct Persistence {
  Persistence(double deviation, double length)
      : kept(length > 0.0 ? std::exp(-kNodeSpacing / length) : 0.0),
        fresh(deviation * std::sqrt(1.0 - kept * kept)) {}

  double kept, fresh;
};

/// Each of what is drawn has a stream of its own: no reading changes another.
enum Purpose : std::uint8_t { kDrive, kReadings, kHeadings, kArm, kMap };

class SimulatedRun final : public WorldRun {
 public:
  SimulatedRun(const World& world, double velocity, const SearchPoints& side, std::uint64_t key)
      : world_(world),
        velocity_(velocity),
        listed_(side),
        drive_(mix_keys(key, kDrive)),
        readings_(mix_keys(key, kReadings)),
        headings_(mix_keys(key, kHeadings)),
        arm_(mix_keys(key, kArm)),
        speed_(world.speed_std, world.speed_length),
        wander_(world.odo_std, world.odo_length) {
    slip_ = world.slip_mean + world.slip_std * drive_.normal();
    curvature_ = world.curvature_mean + world.curvature_std * drive_.normal();
    odometry_bias_ = draw_pair(drive_, world.odo_bias_std);
    const Vector2d start = side.front() - first_displacement();
    Node first;
    first.pose = Pose2(start.x(), start.y(), world.heading_std * drive_.normal());
    first.speed = world.speed_std * drive_.normal();
    first.odometry = draw_pair(drive_, world.odo_std);
    nodes_.push_back(first);
    RandomStream map(mix_keys(key, kMap));
    for (const Vector2d& fiducial : side) {
      true_.emplace_back(fiducial + draw_pair(map, world.map_std));
    }
  }

  Pose2 pose(double t) override {
    const Place at = place_at(t);
    Pose2 pose = at.from->pose + at.share * (at.to->pose - at.from->pose);
    pose.y() += world_.creep * std::max(0.0, t - world_.start_lag);
    return pose;
  }

  Pose2 odometry(double t) override {
    const Place at = place_at(t);
    Pose2 seen = pose(t);
    seen.head<2>() += odometry_bias_ + at.from->odometry +
                      at.share * (at.to->odometry - at.from->odometry) +
                      draw_pair(readings_, world_.odo_white);
    seen.z() += world_.odo_heading_std * headings_.normal();
    return seen;
  }

  ArmPlacement place(const Vector2d& command) override {
    if (moved_) {
      seen_error_ = draw_pair(arm_, world_.arm_std);
      hidden_error_ = draw_pair(arm_, world_.arm_hidden_std);
      moved_ = false;
    }
    ArmPlacement placement;
    placement.seen = command + seen_error_;
    placement.actual = placement.seen + hidden_error_ + draw_pair(arm_, world_.sample_std);
    return placement;
  }

  bool detects(const Vector2d& tool, const Vector2d& fiducial) override {
    const auto distance = [&](const Vector2d& p) { return (p - fiducial).squaredNorm(); };
    const auto nearest = std::ranges::min_element(listed_, {}, distance);
    const Vector2d& at = true_[static_cast<std::size_t>(nearest - listed_.begin())];
    return (tool - at).squaredNorm() <= world_.detection_radius * world_.detection_radius;
  }

  double move_time(const Vector2d& from, const Vector2d& to) override {
    moved_ = true;
    return world_.move_time + (to - from).norm() / world_.move_speed;
  }

  double sample_time(const Vector2d& from, const Vector2d& to) override {
    return world_.sample_time + (to - from).norm() / world_.sample_speed;
  }

  bool reaches(const Vector2d& command) override { return std::abs(command.x()) <= world_.reach; }

 private:
  struct Node {
    Pose2 pose = Pose2::Zero();
    double speed = 0.0;  // share of the speed above the mean
    Vector2d odometry = Vector2d::Zero();
  };

  struct Place {
    const Node* from;
    const Node* to;
    double share;
  };

  Place place_at(double t) {
    const double nodes = velocity_ * std::max(0.0, t - world_.start_lag) / kNodeSpacing;
    const auto i = static_cast<std::size_t>(nodes);
    while (nodes_.size() < i + 2) {
      extend();
    }
    return {&nodes_[i], &nodes_[i + 1], nodes - static_cast<double>(i)};
  }

  void extend() {
    const Node& last = nodes_.back();
    Node next;
    next.speed = speed_.kept * last.speed + speed_.fresh * drive_.normal();
    next.odometry = wander_.kept * last.odometry + draw_pair(drive_, wander_.fresh);
    const double step = kNodeSpacing * (1.0 - slip_ + 0.5 * (last.speed + next.speed));
    const double turn =
        curvature_ * kNodeSpacing + world_.heading_walk * std::sqrt(kNodeSpacing) * drive_.normal();
    const double heading = last.pose.z() + 0.5 * turn;
    next.pose = last.pose + Pose2(step * std::cos(heading), step * std::sin(heading), turn);
    nodes_.push_back(next);
  }

  World world_;
  double velocity_;
  SearchPoints listed_, true_;
  RandomStream drive_, readings_, headings_, arm_;
  Persistence speed_, wander_;
  double slip_, curvature_;
  Vector2d odometry_bias_;
  std::vector<Node> nodes_;
  Vector2d seen_error_ = Vector2d::Zero();
  Vector2d hidden_error_ = Vector2d::Zero();
  bool moved_ = true;
};

struct WorldValue {
  const char* name;
  double World::*member;
};

constexpr std::array kDeviations{WorldValue{"slip_std", &World::slip_std},
                                 WorldValue{"speed_std", &World::speed_std},
                                 WorldValue{"speed_length", &World::speed_length},
                                 WorldValue{"heading_std", &World::heading_std},
                                 WorldValue{"curvature_std", &World::curvature_std},
                                 WorldValue{"heading_walk", &World::heading_walk},
                                 WorldValue{"start_lag", &World::start_lag},
                                 WorldValue{"arm_std", &World::arm_std},
                                 WorldValue{"arm_hidden_std", &World::arm_hidden_std},
                                 WorldValue{"sample_std", &World::sample_std},
                                 WorldValue{"odo_bias_std", &World::odo_bias_std},
                                 WorldValue{"odo_std", &World::odo_std},
                                 WorldValue{"odo_length", &World::odo_length},
                                 WorldValue{"odo_white", &World::odo_white},
                                 WorldValue{"odo_heading_std", &World::odo_heading_std},
                                 WorldValue{"map_std", &World::map_std},
                                 WorldValue{"sample_time", &World::sample_time},
                                 WorldValue{"move_time", &World::move_time}};
constexpr std::array kPositive{
    WorldValue{"detection_radius", &World::detection_radius},
    WorldValue{"sample_speed", &World::sample_speed}, WorldValue{"move_speed", &World::move_speed},
    WorldValue{"u_max", &World::u_max}, WorldValue{"reach", &World::reach}};
constexpr std::array kAnyNumber{WorldValue{"slip_mean", &World::slip_mean},
                                WorldValue{"curvature_mean", &World::curvature_mean},
                                WorldValue{"creep", &World::creep}};

}  // namespace

void check_world(const World& world) {
  const auto check = [&](const auto& values, const char* expected, const auto& is_right) {
    for (const WorldValue& value : values) {
      const double number = world.*value.member;
      if (!std::isfinite(number) || !is_right(number)) {
        throw InvalidArgument(value.name, text(number), expected);
      }
    }
  };
  check(kDeviations, "a finite number >= 0", [](double v) { return v >= 0.0; });
  check(kPositive, "a finite number > 0", [](double v) { return v > 0.0; });
  check(kAnyNumber, "a finite number", [](double) { return true; });
}

std::unique_ptr<WorldRun> start_run(const World& world, double velocity, const SearchPoints& side,
                                    std::uint64_t key) {
  return std::make_unique<SimulatedRun>(world, velocity, side, key);
}

}  // namespace thing_kin
