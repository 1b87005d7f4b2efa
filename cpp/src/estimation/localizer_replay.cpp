// How a BaseLocalizer computes: from the belief after one measurement to those after all later.

#include <algorithm>
#include <bit>
#include <cmath>

#include "thing_kin/core/error.hpp"
#include "thing_kin/estimation/base_localizer.hpp"

namespace thing_kin {

void BaseLocalizer::set_cursors(double a, Cursors& cursors) const {
  cursors.resize(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    cursors[i] = sources_[i].track.after(a);
  }
}

std::vector<TwistShare>& BaseLocalizer::shares_of(const Cursors& cursors, double a,
                                                  double b) const {
  shares_.clear();
  for (const int i : by_name_) {
    const TwistShare share =
        share_of(source_at(i).track, cursors[static_cast<std::size_t>(i)], a, b, origin());
    if (share.sample != nullptr) {
      shares_.push_back(share);
    }
  }
  return shares_;
}

// A sample is judged where it begins to count, against the others that cover that stretch; of two
// that begin together, the second by name.
void BaseLocalizer::judge_beginning(const Cursors& cursors, double a, double b) {
  for (std::size_t p = 0; p < by_name_.size() && by_name_.size() > 1; ++p) {
    const auto i = static_cast<std::size_t>(by_name_[p]);
    auto& samples = sources_[i].track.samples;
    if (cursors[i] >= samples.size() || samples[cursors[i]].first ||
        samples[cursors[i]].start != a) {
      continue;
    }
    shares_.clear();
    for (std::size_t q = 0; q < by_name_.size(); ++q) {
      const auto j = static_cast<std::size_t>(by_name_[q]);
      const TwistShare share = share_of(sources_[j].track, cursors[j], a, b, origin());
      if (q != p && share.rank == 2 && (q < p || share.sample->start < a)) {
        shares_.push_back(share);
      }
    }
    samples[cursors[i]].verdict = judge(samples[cursors[i]], shares_);
  }
}

void BaseLocalizer::advance(PoseBelief& belief, const Cursors& cursors, double a,
                            double b) const noexcept {
  const TwistMix mixed = mix(shares_of(cursors, a, b));
  belief.predict({mixed.twist * (b - a), mixed.increment, options_.process_noise * (b - a)},
                 options_.filter);
}

void BaseLocalizer::apply(Step& step, PoseBelief& belief) const {
  const LocalizerMeasurement& m = step.measurement;
  if (m.kind == MeasurementKind::kTwist) {
    return;  // it moves the pose; see advance()
  }
  if (m.kind == MeasurementKind::kClone) {
    step.verdict.accepted = belief.clone(step.id);
    return;
  }
  const auto rows = static_cast<std::size_t>(std::popcount(m.mask));
  const PoseMeasurement measured{m.z, m.R, m.mask, m.bound[rows]};
  if (m.kind == MeasurementKind::kRelative) {
    step.verdict = belief.update_relative(step.id, measured, options_.filter);
    belief.forget(step.id);
  } else {
    step.verdict = belief.update(measured);
  }
}

void BaseLocalizer::replay(std::size_t from) {
  PoseBelief belief = from > 0 ? record_[from - 1].belief : base_;
  double a = from > 0 ? record_[from - 1].measurement.t
                      : base_time_.value_or(record_.front().measurement.t);
  set_cursors(a, cursors_);
  for (std::size_t k = from; k < record_.size(); ++k) {
    Step& step = record_[k];
    const double b = step.measurement.t;
    if (b > a) {
      judge_beginning(cursors_, a, b);
      advance(belief, cursors_, a, b);
      a = b;
      for (std::size_t i = 0; i < sources_.size(); ++i) {
        const auto& samples = sources_[i].track.samples;
        while (cursors_[i] < samples.size() && samples[cursors_[i]].t <= a) {
          ++cursors_[i];
        }
      }
    }
    apply(step, belief);
    step.belief = belief;
  }
}

BaseEstimate BaseLocalizer::estimate(std::optional<double> t) const {
  if (!latest_ && !base_time_) {
    throw InvalidArgument("t", t ? text(*t) : "None", "a measurement first: time has not begun");
  }
  const double begin = base_time_ ? *base_time_ : record_.front().measurement.t;
  BaseEstimate out;
  out.t = t.value_or(latest_.value_or(begin));
  check_time(out.t, "t");
  if (out.t < begin) {
    throw InvalidArgument(
        "t", text(out.t - begin) + " s from where the history begins",
        begin == origin() ? "no time before the first" : "a time within the history");
  }
  const auto place = std::ranges::upper_bound(record_, out.t, {},
                                              [](const Step& step) { return step.measurement.t; });
  const bool any = place != record_.begin();
  PoseBelief belief = any ? (place - 1)->belief : base_;
  const double a = any ? (place - 1)->measurement.t : begin;
  Cursors cursors;
  if (out.t > a) {
    set_cursors(a, cursors);
    advance(belief, cursors, a, out.t);
  }
  // The twist of the stretch that ends at t.
  const double before_t = time_before(out.t);
  const double from = std::isfinite(before_t) ? before_t : out.t;
  set_cursors(from, cursors);
  const TwistMix mixed = mix(shares_of(cursors, from, std::max(from, out.t)));
  out.pose = belief.pose();
  out.covariance = belief.P();
  out.twist = mixed.twist;
  out.twist_covariance = mixed.covariance;
  return out;
}

}  // namespace thing_kin
