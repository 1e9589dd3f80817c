#include "proof/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <set>

#include "proof/student.h"

namespace proof {
namespace {

__attribute__((format(printf, 1, 2))) std::string format(const char* text, ...) {
    char line[400];
    va_list arguments;
    va_start(arguments, text);
    std::vsnprintf(line, sizeof line, text, arguments);
    va_end(arguments);
    return line;
}

// The last of `items` that `is` true for, or a new one behind them.
template <class Item, class Is>
Item& findOrAdd(std::vector<Item>& items, const Is& is) {
    const auto found = std::find_if(items.begin(), items.end(), is);
    return found != items.end() ? *found : items.emplace_back();
}

void place(Table& table, const Entry& entry, Lines lines) {
    const Subject& subject = entry.cell->subject;
    const bool byScene = lines == Lines::Scenes;
    const std::string& head = byScene ? subject.row : subject.scene;
    const std::string& name = byScene ? subject.scene : subject.row;
    const std::string title = format("%s, %ux%u", head.c_str(), subject.width, subject.height);
    Summary& summary = findOrAdd(table.summaries, [&](const Summary& s) { return s.title == title; });
    summary.title = title;
    if (std::find(summary.scenarios.begin(), summary.scenarios.end(), subject.scenario) ==
        summary.scenarios.end())
        summary.scenarios.push_back(subject.scenario);
    SummaryRow& row = findOrAdd(summary.rows, [&](const SummaryRow& r) { return r.name == name; });
    row.name = name;
    row.settings = subject.settings;
    row.entries[subject.scenario] = entry;
}

void conclude(SummaryRow& row) {
    double blocks = 0, squares = 0, variance = 0;
    row.verdict = Verdict::Unbiased;
    for (const auto& [scenario, entry] : row.entries) {
        const Judgement& j = entry.judgement;
        const double n = double(j.agreement.blocks);
        row.worstZ = std::max({row.worstZ, j.agreement.worstZ, j.worstMeanZ});
        row.verdict = std::max(row.verdict, j.verdict);
        blocks += n;
        squares += n * j.meanSquare;
        variance += n * n * j.meanSquareSpread * j.meanSquareSpread;
    }
    row.meanSquare = squares / blocks;
    row.meanSquareSpread = std::sqrt(variance) / blocks;
}

std::string percent(double ratio, double halfWidth) {
    return format("%+.2f ± %.2f", 100 * ratio, 100 * halfWidth);
}

std::string rowText(const Summary& summary, const SummaryRow& row) {
    std::string text = "| `" + row.name + "` |";
    for (const std::string& scenario : summary.scenarios) {
        const auto found = row.entries.find(scenario);
        if (found == row.entries.end()) {
            text += " |";
            continue;
        }
        const Judgement& j = found->second.judgement;
        text += " " + percent(j.agreement.luminanceRatio.mean, j.agreement.halfWidth) +
                (j.verdict == Verdict::Unbiased ? "" : std::string(" ") + nameOf(j.verdict)) + " |";
    }
    return text + format(" %.1f | %.2f ± %.2f | %s |\n", row.worstZ, row.meanSquare, row.meanSquareSpread,
                         nameOf(row.verdict));
}

std::string headLine(const std::vector<std::string>& heads) {
    std::string text = "|", rule = "|";
    for (const std::string& head : heads) {
        text += " " + head + " |";
        rule += "---|";
    }
    return text + "\n" + rule + "\n";
}

std::string detailText(const SummaryRow& row, const std::string& scenario, const Entry& entry) {
    const Agreement& a = entry.judgement.agreement;
    const Agreement last = compare(entry.cell->last, referenceFromSeeds(entry.reference->last));
    return format("| `%s` | %s | %zu | %+.2f %+.2f %+.2f | ", row.name.c_str(), scenario.c_str(),
                  entry.cell->sequences(), 100 * a.channelRatio[0], 100 * a.channelRatio[1],
                  100 * a.channelRatio[2]) +
           percent(last.luminanceRatio.mean, last.halfWidth) +
           format(" | %.4f | %.2f | %.1f | %.1f | `%s` |\n", entry.cell->relativeError(*entry.reference),
                  entry.cell->noise.value(), a.skewness, entry.cell->seconds / 60, row.settings.c_str());
}

}   // namespace

Table tabulate(const ProofFile& file, double halfWidth, Lines lines) {
    Table table{.halfWidth = halfWidth};
    std::vector<Entry> entries;
    std::set<std::string> commits;
    for (const Cell& cell : file.cells) {
        if (cell.sequences() < kLeastSequences) continue;
        Entry entry{.cell = &cell, .reference = &file.referenceOf(cell)};
        entry.judgement.agreement = cell.agreement(*entry.reference);
        table.hypotheses += hypothesesOf(entry.judgement.agreement);
        entries.push_back(entry);
        commits.insert(cell.commit);
    }
    for (const std::string& commit : commits) table.commits += (table.commits.empty() ? "" : ", ") + commit;
    for (Entry& entry : entries) {
        const Bounds bounds{.hypotheses = table.hypotheses, .halfWidth = halfWidth};
        entry.judgement = judge(entry.judgement.agreement, double(entry.cell->sequences()) - 1, bounds);
        table.zBound = std::max(table.zBound, entry.judgement.zBound);
        place(table, entry, lines);
    }
    for (Summary& summary : table.summaries)
        for (SummaryRow& row : summary.rows) conclude(row);
    return table;
}

std::string biasTable(const Table& table) {
    std::string text;
    for (const Summary& summary : table.summaries) {
        std::vector<std::string> heads{summary.title + ": bias in %"};
        for (const std::string& scenario : summary.scenarios) heads.push_back(scenario);
        heads.insert(heads.end(), {"worst \\|z\\|", "mean z²", "verdict"});
        text += headLine(heads);
        for (const SummaryRow& row : summary.rows) text += rowText(summary, row);
        text += "\n";
    }
    return text +
           format(
               "Of luminance, ± the half-width of the 95 %% confidence interval. Unbiased: every |z| of %.0f "
               "hypotheses (blocks, channels, luminance, mean z² of each cell) inside the bound that all of "
               "them "
               "keep with probability %g, %.1f here, and the interval within ± %g %%. Open: more sequences "
               "needed. Commit %s.\n",
               table.hypotheses, 1 - kAlpha, table.zBound, 100 * table.halfWidth, table.commits.c_str());
}

std::string detailTable(const Table& table) {
    std::string text;
    for (const Summary& summary : table.summaries) {
        text += headLine({summary.title, "scenario", "sequences", "bias of R, G, B in %", "of the last frame",
                          "error of a frame", "correlation", "skewness", "minutes", "settings"});
        for (const SummaryRow& row : summary.rows)
            for (const auto& [scenario, entry] : row.entries) text += detailText(row, scenario, entry);
        text += "\n";
    }
    return text;
}

}   // namespace proof
