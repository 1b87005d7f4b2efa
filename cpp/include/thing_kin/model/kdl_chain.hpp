#pragma once

#include <memory>

#include "thing_kin/core/types.hpp"
#include "thing_kin/lie/se3.hpp"
#include "thing_kin/model/chain.hpp"

namespace thing_kin {

/// The same chain as a KDL::Chain, with KDL's own solvers: an independent oracle, and a back end
/// for users who come from KDL. q is in the order of the Chain. One object serves one thread.
class KdlChain {
 public:
  explicit KdlChain(const Chain& chain);
  ~KdlChain();
  KdlChain(KdlChain&&) noexcept;
  KdlChain& operator=(KdlChain&&) noexcept;
  KdlChain(const KdlChain&) = delete;
  KdlChain& operator=(const KdlChain&) = delete;

  int dof() const;

  /// Pose of a frame (an index into Chain::frames()) in the root.
  SE3 fk(const VectorView& q, int frame);

  /// Geometric Jacobian of the tool, axes of the world, [linear; angular].
  Jacobian jacobian(const VectorView& q);

  /// Where one run of ChainIkSolverPos_LMA ends, whether it was successful or not.
  struct Descent {
    JointVector q;  ///< may be anywhere: KDL knows no limits, and turns joints many times
    int iterations = 0;
  };

  /// One run towards a pose of the tool, with KDL's own weights [1, 1, 1, 0.01, 0.01, 0.01].
  /// `tolerance` bounds the norm of the weighted error. Allocates when it or `most` changes.
  Descent descend(const SE3& target, const VectorView& start, double tolerance, int most);

 private:
  struct Solvers;
  std::unique_ptr<Solvers> solvers_;
};

}  // namespace thing_kin
