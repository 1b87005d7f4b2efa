#pragma once

namespace thing_kin {

/// The most joints a chain may have. Every size in a control loop is bounded by it, so that the
/// loop's matrices live on the stack and nothing there allocates.
inline constexpr int kMaxDof = 32;

}  // namespace thing_kin
