#include "proof/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include <common/setting_options.h>

namespace proof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kMostBlocks = 256;   // the covariance of all of them is kept
constexpr double kSecondsBetweenSaves = 10;
constexpr size_t kLeastForTarget = 24;   // sequences before a half-width is believed

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Drops what is to be made anew. `item.commit` names all commits that had a part.
template <class Item>
void reconcile(std::deque<Item>& items, const Subject& subject, Stale stale) {
    const auto found = std::find_if(items.begin(), items.end(),
                                    [&](const Item& item) { return item.subject.samePlace(subject); });
    if (found == items.end()) return;
    const bool sameText = found->subject == subject;
    const bool sameCommit = found->commit.ends_with(builtCommit());
    if (sameText && sameCommit) return;
    if (stale == Stale::Redo) {
        items.erase(found);
        return;
    }
    if (!sameText) {
        throw std::runtime_error(subject.title() + " has other settings or frames in the file ('" +
                                 found->subject.settings + "', now '" + subject.settings + "'): --redo it");
    }
    if (stale == Stale::Refuse) {
        throw std::runtime_error(subject.title() + " is of commit " + found->commit + ", now " +
                                 builtCommit() + ": --redo it, or --keep it and go on");
    }
    found->commit += std::string("+") + builtCommit();
}

class Runner {
public:
    Runner(const Plan& plan, ProofFile& file, Prover& prover,
           const std::function<void(const std::string&)>& say)
        : plan_(plan), file_(file), prover_(prover), say_(say) {
        prepare();
    }

    void run() {
        for (const Scenario& scenario : plan_.scenarios)
            for (const Transport& transport : transports_) makeReference(scenario, transport);
        start_ = Clock::now();
        bool some = true;
        while (some && !late()) {
            some = false;
            for (const Scenario& scenario : plan_.scenarios)
                for (const Row& row : plan_.rows) some = advance(scenario, row) || some;
        }
        file_.save();
    }

private:
    Subject referenceSubject(const Scenario& scenario, const Transport& transport) const {
        Subject subject = subjectOf(plan_.scene, plan_.extent, scenario, {});
        subject.transport = transport.name();
        subject.settings = std::to_string(paths(scenario)) + " paths";
        return subject;
    }
    uint32_t paths(const Scenario& scenario) const {
        return scenario.changes() ? std::max(1u, plan_.reference.paths / scenario.counted())
                                  : plan_.reference.paths;
    }

    void prepare() {
        for (const Row& row : plan_.rows) {
            const Transport transport = transportOf(samples::parseSettings(row.settings));
            if (std::find(transports_.begin(), transports_.end(), transport) == transports_.end())
                transports_.push_back(transport);
        }
        for (const Scenario& scenario : plan_.scenarios) {
            for (const Transport& transport : transports_)
                reconcile(file_.references, referenceSubject(scenario, transport), plan_.stale);
            for (const Row& row : plan_.rows)
                reconcile(file_.cells, subjectOf(plan_.scene, plan_.extent, scenario, row), plan_.stale);
        }
        file_.save();
    }

    void makeReference(const Scenario& scenario, const Transport& transport) {
        const Subject subject = referenceSubject(scenario, transport);
        Reference* reference = file_.findReference(subject);
        if (!reference) {
            file_.references.push_back({.subject = subject, .commit = builtCommit()});
            reference = &file_.references.back();
        }
        while (reference->sequences() < plan_.reference.sequences) {
            const size_t n = reference->sequences();
            const Take first = prover_.reference(scenario, transport, paths(scenario), subject.seed(n));
            reference->add(first,
                           prover_.reference(scenario, transport, paths(scenario), subject.seed(n + 1)));
            char line[160];
            const Estimate mean = reference->mean.luminanceMean();
            std::snprintf(line, sizeof line, "%s: %zu of %zu sequences, standard error %.3f %%",
                          subject.title().c_str(), n + 2, plan_.reference.sequences,
                          100 * mean.error / mean.mean);
            say_(line);
            saveIfDue();
        }
    }

    void saveIfDue() {
        if (secondsSince(saved_) < kSecondsBetweenSaves) return;
        file_.save();
        saved_ = Clock::now();
    }

    bool late() const { return plan_.limits.minutes > 0 && secondsSince(start_) > 60 * plan_.limits.minutes; }

    bool enough(const Cell& cell, const Reference& reference) const {
        const Limits& limits = plan_.limits;
        if (limits.sequences > 0 && cell.sequences() >= limits.sequences) return true;
        return limits.halfWidth > 0 && cell.sequences() >= kLeastForTarget &&
               cell.agreement(reference).halfWidth <= limits.halfWidth;
    }

    // A batch for a cell; false: it has enough.
    bool advance(const Scenario& scenario, const Row& row) {
        const Subject subject = subjectOf(plan_.scene, plan_.extent, scenario, row);
        Cell* cell = file_.findCell(subject);
        if (!cell) {
            file_.cells.push_back({.subject = subject, .commit = builtCommit()});
            cell = &file_.cells.back();
        }
        const Reference& reference = file_.referenceOf(*cell);
        if (late() || enough(*cell, reference)) return false;
        const restir::Settings settings = samples::parseSettings(row.settings);
        const Clock::time_point start = Clock::now();
        for (size_t i = 0; i < plan_.batch; i += 2) {
            if (plan_.limits.sequences > 0 && cell->sequences() >= plan_.limits.sequences) break;
            const size_t n = cell->sequences();
            const Take first = prover_.estimate(scenario, settings, subject.seed(n));
            cell->add(first, prover_.estimate(scenario, settings, subject.seed(n + 1)), reference);
        }
        cell->seconds += secondsSince(start);
        report(*cell, reference);
        saveIfDue();
        return true;
    }

    void report(const Cell& cell, const Reference& reference) const {
        const Agreement a = cell.agreement(reference);
        const double target = plan_.limits.halfWidth > 0 ? plan_.limits.halfWidth : Bounds{}.halfWidth;
        const double more = sequencesFor(target, cell.mean, reference.mean) - double(cell.sequences());
        const double minutes = std::max(0.0, more) * cell.seconds / double(cell.sequences()) / 60;
        char line[240];
        std::snprintf(line, sizeof line, "%s: %zu sequences, %+.2f +- %.2f %%, %.1f minutes to +- %g %%%s",
                      cell.subject.title().c_str(), cell.sequences(), 100 * a.luminanceRatio.mean,
                      100 * a.halfWidth, minutes, 100 * target,
                      std::isinf(minutes) ? ": the reference is too noisy" : "");
        say_(line);
    }

    const Plan& plan_;
    ProofFile& file_;
    Prover& prover_;
    const std::function<void(const std::string&)>& say_;
    std::vector<Transport> transports_;        // of the plan's rows
    Clock::time_point start_ = Clock::now();   // of the cells
    Clock::time_point saved_ = start_;
};

}   // namespace

double sequencesFor(double halfWidth, const SeedStatistics& cell, const SeedStatistics& reference) {
    constexpr double kNormal = 1.96;
    const Estimate truth = reference.luminanceMean(), mean = cell.luminanceMean();
    const double allowed = std::pow(halfWidth * truth.mean / kNormal, 2) - truth.error * truth.error;
    if (allowed <= 0) return std::numeric_limits<double>::infinity();
    return mean.error * mean.error / allowed * double(cell.pictures());
}

void check(const Plan& plan) {
    const uint32_t blocks = (plan.extent.width / kBlock) * (plan.extent.height / kBlock);
    if (blocks == 0 || blocks > kMostBlocks) {
        throw std::runtime_error("--size: a bias is measured on 1 to " + std::to_string(kMostBlocks) +
                                 " blocks of 8x8 pixels, not " + std::to_string(blocks));
    }
    if (plan.rows.empty())
        throw std::runtime_error("nothing to measure: --table NAME, or --row NAME='settings'");
    if (plan.limits.sequences % 2 == 1)
        throw std::runtime_error("--seeds: an even number, sequences go in pairs");
    if (plan.limits.sequences == 0 && plan.limits.halfWidth <= 0 && plan.limits.minutes <= 0)
        throw std::runtime_error("no end: --seeds, --half-width or --minutes");
}

void run(const Plan& plan, ProofFile& file, Prover& prover,
         const std::function<void(const std::string&)>& say) {
    check(plan);
    Runner(plan, file, prover, say).run();
}

}   // namespace proof
