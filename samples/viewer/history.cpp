#include "viewer/history.h"

#include <algorithm>
#include <numeric>

namespace viewer {

Pacing pacingOf(std::vector<double> milliseconds) {
    if (milliseconds.empty()) return {};
    std::sort(milliseconds.begin(), milliseconds.end());
    const size_t count = milliseconds.size();
    return {
        .frames = count,
        .mean = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0) / static_cast<double>(count),
        .p95 = milliseconds[std::min(count - 1, count * 95 / 100)],
        .max = milliseconds.back()};
}

void History::endFrame(bool interrupted) {
    const Clock::time_point now = Clock::now();
    if (last_) {
        const double milliseconds = std::chrono::duration<double, std::milli>(now - *last_).count();
        (interrupted ? interruptions_ : steady_).push_back(milliseconds);
        if (!records_.empty()) records_.back().frame = milliseconds;
    }
    last_ = now;
}

void History::addTimings(std::span<const restir::PassTiming> timings) {
    FrameRecord record;
    auto next = order_.begin();
    for (const restir::PassTiming& timing : timings) {
        auto place =
            std::find_if(order_.begin(), order_.end(), [&](size_t i) { return passes_[i] == timing.name; });
        if (place == order_.end()) {
            place = order_.insert(next, passes_.size());
            passes_.emplace_back(timing.name);
        }
        next = place + 1;
        record.passes.resize(passes_.size());
        record.passes[*place] += timing.milliseconds;
    }
    records_.push_back(std::move(record));
    if (records_.size() > kShown) records_.pop_front();
}

void History::addError(double error) {
    errors_.push_back(static_cast<float>(error));
    if (errors_.size() > kShown) errors_.erase(errors_.begin());
}

}   // namespace viewer
