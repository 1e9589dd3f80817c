// What the last frames took and how good they were.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <restir/frame.h>

namespace viewer {

struct FrameRecord {
    std::vector<double> passes;   // GPU ms, for each of History::passes()
    double frame = 0;             // ms from the last frame to this one
};

// Of a whole session.
struct Pacing {
    size_t frames = 0;
    double mean = 0, p95 = 0, max = 0;   // ms
};
Pacing pacingOf(std::vector<double> milliseconds);

class History {
public:
    static constexpr size_t kShown = 160;

    // Once a frame. `interrupted`: it waited for a scene or for new images, which is counted apart.
    void endFrame(bool interrupted);
    // Passes of one name are added up.
    void addTimings(std::span<const restir::PassTiming> timings);
    void addError(double error);
    void forgetErrors() { errors_.clear(); }

    const std::vector<std::string>& passes() const { return passes_; }
    // Of passes(): as they follow one another in a frame, those that not every frame has in their places.
    const std::vector<size_t>& order() const { return order_; }
    const std::deque<FrameRecord>& records() const { return records_; }
    const std::vector<float>& errors() const { return errors_; }
    const std::vector<double>& steady() const { return steady_; }   // ms of each frame of the session so far
    const std::vector<double>& interruptions() const { return interruptions_; }

private:
    using Clock = std::chrono::steady_clock;

    std::vector<std::string> passes_;
    std::vector<size_t> order_;
    std::deque<FrameRecord> records_;
    std::vector<float> errors_;
    std::vector<double> steady_, interruptions_;
    std::optional<Clock::time_point> last_;
};

}   // namespace viewer
