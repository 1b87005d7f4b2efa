#pragma once

#include <limits>
#include <vector>

#include "thing_kin/rmma/world_run.hpp"
#include "thing_kin/search/spiral.hpp"

namespace thing_kin {

/// What became of one fiducial.
struct Attempt {
  bool searched = false;     ///< neither registered at rest nor skipped
  bool intercepted = false;  ///< also when registered
  double search_time = 0.0;  ///< s, from the first stop to the end
  double position_error = std::numeric_limits<double>::quiet_NaN();  ///< m, before the update
  int samples = 0;                                                   ///< stops of the laser
};

/// One search in all detail, for pictures. Vectors in the side's frame.
struct SearchTrace {
  int fiducial = 0;
  double start = 0.0, end = 0.0;
  bool hit = false;
  double position_error = 0.0;
  Eigen::Vector2d predicted = Eigen::Vector2d::Zero();   ///< base, when the search was meant
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of it; zero where there is none
  std::vector<double> times;                             ///< of the stops
  std::vector<Eigen::Vector2d> tools;                    ///< where the tool was
};

/// One side: what became of its fiducials, in their order, and if asked for the searches.
struct SideOutcome {
  std::vector<Attempt> attempts;
  std::vector<SearchTrace>* trace = nullptr;
};

/// The fiducial to look for after the one with the index `previous`, [X21] (3.3) with the outer
/// absolute value that it lacks: the one whose way along x is nearest to what the base has gone.
/// `side.size()` after the last.
std::size_t next_fiducial(const SearchPoints& side, std::size_t previous,
                          double travelled) noexcept;

/// The arm during a side: where it was sent last, what it costs to send it on, what it saw.
class SearchArm {
 public:
  explicit SearchArm(WorldRun& run) : run_(run) {}

  /// Sends it to another place of work; s until it is there.
  double move_to(const Eigen::Vector2d& command);
  /// Sends it to the next sample; s until the laser is read there.
  double sample_at(const Eigen::Vector2d& command);
  /// Says where it is to be when it arrives, for what has become better known under way.
  void send(const Eigen::Vector2d& command) noexcept { command_ = command; }
  /// s that sample_at() would take.
  double sample_time(const Eigen::Vector2d& command) { return run_.sample_time(command_, command); }

  /// Stops and reads the laser at time t.
  bool sees(double t, const Eigen::Vector2d& fiducial, SearchTrace* trace);
  /// Stops without reading it.
  void look() { placement_ = run_.place(command_); }

  const Eigen::Vector2d& command() const noexcept { return command_; }
  const Eigen::Vector2d& seen() const noexcept { return placement_.seen; }
  WorldRun& run() noexcept { return run_; }

 private:
  WorldRun& run_;
  Eigen::Vector2d command_ = Eigen::Vector2d::Zero();
  ArmPlacement placement_{};
};

/// With the base at rest the arm looks for the first fiducial, in spirals: five attempts, then
/// wider and denser ones. What forward kinematics said when it was seen is in arm.seen(); false if
/// it never was.
bool register_first(SearchArm& arm, const Eigen::Vector2d& fiducial);

}  // namespace thing_kin
