// What the mean of an estimator converges to.
#include <cstdio>
#include <memory>

#include "bench/command.h"
#include "common/setting_options.h"
#include "proof/run.h"

namespace bench {
namespace {

struct Options {
    samples::SceneOptions scene{.scene = "builtin:cornell"};
    std::string table, json;
    VkExtent2D extent{64, 64};
    std::vector<std::string> scenarios{"static"}, rows;
    uint32_t frames = 0;
    int32_t warmUp = -1;
    double halfWidthPercent = 0;
    proof::Limits limits;
    proof::ReferenceQuality reference;
    std::optional<restir::RayBackend> rays;
    bool keep = false, redo = false, validate = false;
};

proof::Plan planOf(const Options& options) {
    proof::Plan plan{.scene = samples::sceneText(options.scene),
                     .extent = options.extent,
                     .limits = options.limits,
                     .reference = options.reference};
    plan.limits.halfWidth = options.halfWidthPercent / 100;
    plan.stale = options.redo ? proof::Stale::Redo : options.keep ? proof::Stale::Keep : proof::Stale::Refuse;
    if (!options.table.empty()) plan.rows = proof::namedRows(options.table);
    for (const std::string& text : options.rows) plan.rows.push_back(proof::parseRow(text));
    for (const std::string& name : options.scenarios) {
        proof::Scenario scenario = proof::findScenario(name);
        if (options.frames > 0) scenario.frames = options.frames;
        if (options.warmUp >= 0) scenario.warmUp = uint32_t(options.warmUp);
        if (scenario.warmUp >= scenario.frames)
            throw std::runtime_error("--warm-up: no frame of " + std::to_string(scenario.frames) + " counts");
        plan.scenarios.push_back(scenario);
    }
    return plan;
}

void run(const Options& options) {
    const proof::Plan plan = planOf(options);
    proof::check(plan);
    proof::ProofFile file(options.json);
    restir::SessionDesc session;
    for (const proof::Row& row : plan.rows)
        samples::declareFor(samples::parseSettings(row.settings), session);
    samples::SceneData scene = load(options.scene);
    scene.views = {samples::chooseView(options.scene, scene)};
    samples::Device device({.validate = options.validate});
    proof::Prover prover(device, std::move(scene), plan.extent, session, {.rays = options.rays});
    std::fprintf(stderr, "%s, %ux%u, %s, commit %s\n", plan.scene.c_str(), plan.extent.width,
                 plan.extent.height, device.driver().c_str(), proof::builtCommit());
    proof::run(plan, file, prover,
               [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
    if (device.validationMessages() > 0) throw std::runtime_error("validation messages, see above");
}

void addLimits(CLI::App& app, Options& options) {
    app.add_option("--seeds", options.limits.sequences, "independent sequences of each cell")->type_name("N");
    app.add_option("--half-width", options.halfWidthPercent,
                   "until the 95 % confidence interval of a cell's luminance is +- so much of it")
        ->type_name("PERCENT");
    app.add_option("--minutes", options.limits.minutes, "time for all cells together, without the references")
        ->type_name("MINUTES");
    app.add_option("--reference-seeds", options.reference.sequences, "sequences of the reference (64)")
        ->check(CLI::Range(4, 1 << 20))
        ->type_name("N");
    app.add_option("--reference-paths", options.reference.paths,
                   "per pixel of each, over all its frames (256)")
        ->check(CLI::Range(1, 65536))
        ->type_name("N");
    app.add_flag("--keep", options.keep, "go on with cells of another commit, and say so in the file");
    app.add_flag("--redo", options.redo, "begin cells of another commit or with other settings anew")
        ->excludes("--keep");
}

}   // namespace

void addBias(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("bias",
                                           "Independent sequences of estimators against a reference path "
                                           "tracer. Adds to FILE.json what is not in it.");
    std::string known;
    for (const proof::Scenario& scenario : proof::scenarios())
        known += (known.empty() ? "" : "; ") + scenario.name + ": " + scenario.help;
    command->add_option("--json", options->json, "results, gone on with if it exists")
        ->required()
        ->type_name("FILE");
    command->add_option("--scene", options->scene.scene, "a glTF file or builtin:NAME (builtin:cornell)")
        ->type_name("SCENE");
    samples::addSceneOptions(*command, options->scene);
    samples::addSize(*command, options->extent, "of the picture in pixels");
    command->add_option("--scenario", options->scenarios, known + " (static)")
        ->delimiter(',')
        ->type_name("NAME,...");
    command
        ->add_option("--table", options->table,
                     "rows by name. weights: each of weights with each of visibility; presets; options: the "
                     "defaults with one thing changed; indirect: ReSTIR GI")
        ->type_name("NAME");
    addRows(*command, options->rows);
    samples::addRays(*command, options->rays);
    command->add_option("--frames", options->frames, "of a sequence")->type_name("N");
    command->add_option("--warm-up", options->warmUp, "of them, not counted")->type_name("N");
    addLimits(*command, *options);
    command->add_flag("--validate", options->validate,
                      "run under the validation layer; its messages fail the run");
    command->callback([options] { run(*options); });
}

}   // namespace bench
