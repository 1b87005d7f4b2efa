#include "thing_kin/model/kdl_chain.hpp"

#include <optional>
#include <vector>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainjnttojacsolver.hpp>

namespace thing_kin {

namespace {

KDL::Frame to_kdl(const SE3& T) {
  const Eigen::Matrix3d& R = T.rotation;
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          KDL::Vector(T.translation.x(), T.translation.y(), T.translation.z())};
}

KDL::Joint to_kdl(const Segment& segment) {
  switch (segment.type) {
    case JointType::kRevolute:
    case JointType::kContinuous:
      return KDL::Joint(segment.joint, KDL::Joint::RotZ);
    case JointType::kPrismatic:
      return KDL::Joint(segment.joint, KDL::Joint::TransZ);
    case JointType::kFixed:
      break;
  }
  return KDL::Joint(KDL::Joint::Fixed);
}

// A KDL segment is joint, then frame: what stands before a joint is a fixed segment of its own.
KDL::Chain to_kdl(const Chain& chain) {
  KDL::Chain result;
  for (const Segment& segment : chain.description().segments) {
    result.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), to_kdl(segment.before)));
    result.addSegment(KDL::Segment(segment.frame, to_kdl(segment), to_kdl(segment.after)));
  }
  return result;
}

}  // namespace

struct KdlChain::Solvers {
  explicit Solvers(const Chain& source)
      : chain(to_kdl(source)),
        order(source.description().order),
        q(static_cast<unsigned>(source.dof())),
        end(static_cast<unsigned>(source.dof())),
        columns(static_cast<unsigned>(source.dof())),
        fk(chain),
        jacobian(chain) {}

  void set(const VectorView& values) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      q(static_cast<unsigned>(i)) = values[order[i]];
    }
  }

  KDL::ChainIkSolverPos_LMA& descent(double eps, int iterations) {
    if (!lma || tolerance != eps || most != iterations) {
      lma.emplace(chain, eps, iterations);
      tolerance = eps;
      most = iterations;
    }
    return *lma;
  }

  KDL::Chain chain;
  std::vector<int> order;
  KDL::JntArray q, end;
  KDL::Jacobian columns;
  KDL::ChainFkSolverPos_recursive fk;
  KDL::ChainJntToJacSolver jacobian;
  std::optional<KDL::ChainIkSolverPos_LMA> lma;  // made when first wanted
  double tolerance = 0.0;
  int most = 0;
};

KdlChain::KdlChain(const Chain& chain) : solvers_(std::make_unique<Solvers>(chain)) {}
KdlChain::~KdlChain() = default;
KdlChain::KdlChain(KdlChain&&) noexcept = default;
KdlChain& KdlChain::operator=(KdlChain&&) noexcept = default;

int KdlChain::dof() const { return static_cast<int>(solvers_->order.size()); }

SE3 KdlChain::fk(const VectorView& q, int frame) {
  solvers_->set(q);
  KDL::Frame result = KDL::Frame::Identity();
  if (frame > 0) {  // frame 0 is the root, where KDL has no segment
    solvers_->fk.JntToCart(solvers_->q, result, 2 * frame);
  }
  SE3 T;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) {
      T.rotation(row, col) = result.M(row, col);
    }
    T.translation[row] = result.p[row];
  }
  return T;
}

Jacobian KdlChain::jacobian(const VectorView& q) {
  solvers_->set(q);
  solvers_->jacobian.JntToJac(solvers_->q, solvers_->columns);
  Jacobian J(6, dof());
  for (std::size_t i = 0; i < solvers_->order.size(); ++i) {
    J.col(solvers_->order[i]) = solvers_->columns.data.col(static_cast<Eigen::Index>(i));
  }
  return J;
}

KdlChain::Descent KdlChain::descend(const SE3& target, const VectorView& start, double tolerance,
                                    int most) {
  solvers_->set(start);
  KDL::ChainIkSolverPos_LMA& lma = solvers_->descent(tolerance, most);
  solvers_->end = solvers_->q;
  lma.CartToJnt(solvers_->q, to_kdl(target), solvers_->end);
  Descent result{JointVector(dof()), lma.lastNrOfIter};
  for (std::size_t i = 0; i < solvers_->order.size(); ++i) {
    result.q[solvers_->order[i]] = solvers_->end(static_cast<unsigned>(i));
  }
  return result;
}

}  // namespace thing_kin
