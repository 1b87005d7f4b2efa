#include "thing_kin/linalg/null_space.hpp"

namespace thing_kin {

SmallMatrix null_space(const SmallMatrix& A) noexcept {
  Svd svd;
  decompose(A, svd);
  return svd.v.rightCols(A.cols() - svd.rank);
}

SmallMatrix null_space_projector(const SmallMatrix& A) noexcept {
  const SmallMatrix Z = null_space(A);
  return Z * Z.transpose();
}

}  // namespace thing_kin
