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
    for (const restir::PassTiming& timing : timings) {
        auto pass = std::find(passes_.begin(), passes_.end(), timing.name);
        if (pass == passes_.end()) pass = passes_.insert(pass, timing.name);
        const auto at = static_cast<size_t>(pass - passes_.begin());
        record.passes.resize(std::max(record.passes.size(), at + 1));
        record.passes[at] += timing.milliseconds;
    }
    records_.push_back(std::move(record));
    if (records_.size() > kShown) records_.pop_front();
}

void History::addError(double error) {
    errors_.push_back(static_cast<float>(error));
    if (errors_.size() > kShown) errors_.erase(errors_.begin());
}

}   // namespace viewer
