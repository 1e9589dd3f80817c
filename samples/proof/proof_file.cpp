#include "proof/proof_file.h"

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace proof {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr const char* kCommit =
#include "commit.inc"
    ;

Json toJson(const Subject& s) {
    return {{"scene", s.scene},   {"size", {s.width, s.height}}, {"scenario", s.scenario},
            {"frames", s.frames}, {"warmUp", s.warmUp},          {"transport", s.transport},
            {"row", s.row},       {"settings", s.settings}};
}

Subject subjectFrom(const Json& json) {
    return {.scene = json.at("scene"),
            .width = json.at("size").at(0),
            .height = json.at("size").at(1),
            .scenario = json.at("scenario"),
            .frames = json.at("frames"),
            .warmUp = json.at("warmUp"),
            .transport = json.value("transport", ""),   // files from before there was indirect light
            .row = json.at("row"),
            .settings = json.at("settings")};
}

Json toJson(const SeedStatistics& statistics) {
    const BlockSums& sums = statistics.sums();
    return {{"sum", sums.sum}, {"products", sums.products}, {"channels", sums.channels}};
}

SeedStatistics statisticsFrom(const Json& json) {
    BlockSums sums;
    json.at("sum").get_to(sums.sum);
    json.at("products").get_to(sums.products);
    json.at("channels").get_to(sums.channels);
    sums.pictures = sums.channels.size();
    if (sums.products.size() != sums.sum.size() * (sums.sum.size() + 1) / 2)
        throw std::runtime_error("a cell's sums do not fit one another");
    return SeedStatistics(std::move(sums));
}

Json toJson(const Reference& reference) {
    Json json = toJson(reference.subject);
    json["commit"] = reference.commit;
    json["sequences"] = reference.sequences();
    json["mean"] = toJson(reference.mean);
    json["last"] = toJson(reference.last);
    return json;
}

Json toJson(const Cell& cell) {
    Json json = toJson(cell.subject);
    json["commit"] = cell.commit;
    json["sequences"] = cell.sequences();
    json["seconds"] = cell.seconds;
    json["errors"] = cell.errors;
    json["noise"] = {cell.noise.products(), cell.noise.squares()};
    json["convergence"] = cell.convergence;
    json["mean"] = toJson(cell.mean);
    json["last"] = toJson(cell.last);
    return json;
}

// One line for each, so that a person can look at the file.
std::string toText(const ProofFile& file) {
    std::string text = "{\"format\": " + std::to_string(kFormat);
    const auto list = [&](const char* name, const auto& items) {
        text += ",\n\"" + std::string(name) + "\": [";
        const char* separator = "\n";
        for (const auto& item : items) {
            text += separator + toJson(item).dump();
            separator = ",\n";
        }
        text += "]";
    };
    list("references", file.references);
    list("cells", file.cells);
    return text + "}\n";
}

Reference referenceFrom(const Json& json) {
    Reference reference;
    reference.subject = subjectFrom(json);
    reference.commit = json.at("commit");
    reference.mean = statisticsFrom(json.at("mean"));
    reference.last = statisticsFrom(json.at("last"));
    return reference;
}

Cell cellFrom(const Json& json) {
    Cell cell;
    cell.subject = subjectFrom(json);
    cell.commit = json.at("commit");
    cell.seconds = json.at("seconds");
    cell.errors = json.at("errors");
    cell.noise = NoiseCorrelation(json.at("noise").at(0), json.at("noise").at(1));
    json.at("convergence").get_to(cell.convergence);
    cell.mean = statisticsFrom(json.at("mean"));
    cell.last = statisticsFrom(json.at("last"));
    return cell;
}

void parse(const std::string& path, ProofFile& file) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot be opened");
    const Json json = Json::parse(stream);
    if (json.at("format") != kFormat) throw std::runtime_error("has another format");
    for (const Json& reference : json.at("references")) file.references.push_back(referenceFrom(reference));
    for (const Json& cell : json.at("cells")) file.cells.push_back(cellFrom(cell));
}

// Pictures as members, by the name that their files have. `Item` may be const.
template <class Visitor, class Item>
void forPictures(Item& item, const Visitor& visit) {
    visit("mean", item.meanPicture);
    if constexpr (requires { item.onePicture; }) {
        visit("one", item.onePicture);
    } else {
        visit("last", item.lastPicture);
        visit("variance", item.lastVariance);
    }
}

template <class Visitor, class File>
void forAllPictures(File& file, const Visitor& visit) {
    const auto each = [&](auto& items) {
        for (auto& item : items) {
            if (item.sequences() == 0) continue;
            forPictures(item, [&](const char* what, auto& picture) {
                visit(item.subject, what, item.sequences(), picture);
            });
        }
    };
    each(file.references);
    each(file.cells);
}

}   // namespace

const char* builtCommit() { return kCommit; }

ProofFile::ProofFile(std::string path, bool pictures) : path_(std::move(path)) {
    if (!fs::exists(path_)) return;
    try {
        parse(path_, *this);
    } catch (const std::exception& error) {
        throw std::runtime_error(path_ + ": cannot be read: " + error.what());
    }
    if (!pictures) return;
    forAllPictures(
        *this, [&](const Subject& subject, const char* what, size_t sequences, samples::FloatImage& image) {
            image = samples::readExr(pictureName(subject, what, sequences));
        });
}

Reference* ProofFile::findReference(const Subject& subject) {
    for (Reference& reference : references)
        if (reference.subject.samePlace(subject)) return &reference;
    return nullptr;
}

const Reference& ProofFile::referenceOf(const Cell& cell) const {
    Subject subject = cell.subject;
    subject.row.clear();
    for (const Reference& reference : references)
        if (reference.subject.samePlace(subject) && reference.sequences() > 1) return reference;
    throw std::runtime_error(path_ + ": no reference for " + cell.subject.title());
}

Cell* ProofFile::findCell(const Subject& subject) {
    for (Cell& cell : cells)
        if (cell.subject.samePlace(subject)) return &cell;
    return nullptr;
}

// The number of sequences is in the name: until the JSON file is replaced, the old pictures stay.
std::string ProofFile::pictureName(const Subject& subject, const char* what, size_t sequences) const {
    std::string name = subject.scene + "-" + std::to_string(subject.width) + "x" +
                       std::to_string(subject.height) + "-" + subject.scenario + "-" +
                       (subject.row.empty() ? "reference" + subject.transport : subject.row);
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    return path_ + ".pictures/" + name + "-" + std::to_string(sequences) + "-" + what + ".exr";
}

void ProofFile::save() {
    std::error_code error;
    fs::create_directories(path_ + ".pictures", error);
    forAllPictures(std::as_const(*this), [&](const Subject& subject, const char* what, size_t sequences,
                                             const samples::FloatImage& image) {
        const std::string name = pictureName(subject, what, sequences);
        if (!fs::exists(name)) samples::writeExr(name, image);
    });
    const std::string temporary = path_ + ".part";
    std::ofstream stream(temporary, std::ios::binary);
    stream << toText(*this);
    stream.close();
    if (stream) fs::rename(temporary, path_, error);
    if (!stream || error) {
        fs::remove(temporary, error);
        throw std::runtime_error(path_ + ": cannot be written");
    }
    removeOldPictures();
}

void ProofFile::removeOldPictures() const {
    std::set<fs::path> current;
    forAllPictures(
        *this, [&](const Subject& subject, const char* what, size_t sequences, const samples::FloatImage&) {
            current.insert(fs::path(pictureName(subject, what, sequences)).filename());
        });
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(path_ + ".pictures", ignored))
        if (!current.contains(entry.path().filename())) fs::remove(entry.path(), ignored);
}

}   // namespace proof
