#include "host/plans.h"

namespace tests {

std::vector<Settings> allSettings() {
    std::vector<Settings> all;
    for (bool temporal : {false, true})
        for (uint32_t spatial = 0; spatial <= 3; ++spatial)
            for (auto visibility : {VisibilityReuse::None, VisibilityReuse::Cached, VisibilityReuse::Traced})
                all.push_back(settingsOf(temporal, spatial, visibility));
    for (size_t i = 0; i < 24; i += 5) {
        all.push_back(all[i]);
        all.back().debugView = DebugView::Light;
    }
    all.push_back({.di = {.boilingFilter = 0.5f}});
    const size_t separate = all.size();
    for (size_t i = 0; i < separate; ++i) {
        all.push_back(all[i]);
        all.back().di.fused = true;
    }
    for (uint32_t spatial : {1u, 3u})
        all.push_back({.di = {.spatialPasses = spatial, .pairedNeighbours = true}});
    for (auto visibility : {VisibilityReuse::None, VisibilityReuse::Traced})
        all.push_back({.di = {.checkerboard = true, .visibility = visibility}});
    all.push_back({.di = {.fused = true, .checkerboard = true}, .debugView = DebugView::Age});
    all.push_back({.di = {.mode = DirectMode::NextEvent}});
    all.push_back({.di = {.mode = DirectMode::Off}});
    for (auto direct : {DirectMode::Restir, DirectMode::Off})
        for (uint32_t spatial : {0u, 1u, 2u})
            for (bool average : {false, true})
                all.push_back(
                    {.di = {.mode = direct},
                     .gi = {
                         .mode = IndirectMode::Restir, .spatialPasses = spatial, .averageShading = average}});
    for (uint32_t spatial : {1u, 3u})
        for (bool checkerboard : {false, true})
            all.push_back({.di = {.pairedNeighbours = true},
                           .gi = {.mode = IndirectMode::Restir,
                                  .spatialPasses = spatial,
                                  .pairedNeighbours = true,
                                  .checkerboard = checkerboard}});
    for (auto direct : {DirectMode::Restir, DirectMode::NextEvent, DirectMode::Off})
        for (bool checkerboard : {false, true})
            for (auto visibility : {VisibilityReuse::Cached, VisibilityReuse::Traced})
                all.push_back({.di = {.mode = direct, .checkerboard = checkerboard},
                               .gi = {.mode = IndirectMode::Restir,
                                      .checkerboard = true,
                                      .visibility = visibility,
                                      .boilingFilter = 0.5f}});
    for (uint32_t spatial : {1u, 2u})
        for (bool paired : {false, true})
            all.push_back({.gi = {.mode = IndirectMode::Restir,
                                  .spatialPasses = spatial,
                                  .pairedNeighbours = paired,
                                  .halfResolution = true,
                                  .ownPath = !paired}});
    all.push_back({.gi = {.mode = IndirectMode::Path}});
    return all;
}

std::vector<Plan> allPlans(bool lobes) {
    std::vector<Plan> plans;
    for (const Settings& settings : allSettings())
        for (bool history : {false, true})
            for (uint32_t in : {0u, 1u})
                for (bool gradient : {false, true})
                    plans.push_back(makePlan({kExtent, history, in, gradient, history, 1 - in, lobes}, settings));
    return plans;
}

std::vector<Plan> allPlans() {
    std::vector<Plan> plans = allPlans(false);
    for (Plan& plan : allPlans(true)) plans.push_back(std::move(plan));
    return plans;
}

}   // namespace tests
