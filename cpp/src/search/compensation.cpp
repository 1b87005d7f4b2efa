#include "thing_kin/search/compensation.hpp"

namespace thing_kin {

SearchPoints compensated_points(const SearchPoints& points, const Eigen::Vector2d& velocity,
                                const std::vector<double>& times) {
  SearchPoints moved(points);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    moved[k] += velocity * times[k];
  }
  return moved;
}

}  // namespace thing_kin
