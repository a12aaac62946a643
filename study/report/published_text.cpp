// SPDX-License-Identifier: MIT
#include "study/report/published_text.hpp"

#include "base/text.hpp"
#include "study/report/analysis_text.hpp"

namespace burin::study {
namespace {

// Figures of one kind and one group in one table.
struct Block {
    std::vector<const PublishedCheck*> wrong;
    std::size_t all = 0;
};

std::string block_key(const PublishedValue& value) {
    return "Table " + value.table + ", " + name_of(value.quantity) + ", " + value.group;
}

std::string check_line(const PublishedCheck& check) {
    const PublishedValue& v = check.value;
    std::string line = "    ";
    if (v.trial > 0) line += "participant " + v.participant + formatted(", trial %d: ", v.trial);
    line += "prints " + v.text + ", the data give " + number_text(check.from_data);
    if (!check.remark.empty()) line += "  (" + check.remark + ")";
    return line + "\n";
}

}  // namespace

std::string published_text(const PublishedComparison& comparison) {
    // By first appearance, so that a table's figures stand together.
    std::vector<std::pair<std::string, Block>> blocks;
    for (const PublishedCheck& check : comparison.checks) {
        const std::string key = block_key(check.value);
        auto block = std::ranges::find(blocks, key, &std::pair<std::string, Block>::first);
        if (block == blocks.end()) block = blocks.insert(blocks.end(), {key, {}});
        ++block->second.all;
        if (!check.agrees) block->second.wrong.push_back(&check);
    }
    std::string text = "These are the data of a published study: " + comparison.title + ".\n";
    text += formatted("Of %zu figures that it prints, %zu do not follow from its data:\n", comparison.checks.size(),
                      comparison.disagreeing());
    for (const auto& [key, block] : blocks) {
        if (block.wrong.empty()) continue;
        text += formatted("  %s: %zu of %zu\n", key.c_str(), block.wrong.size(), block.all);
        for (const PublishedCheck* check : block.wrong) text += check_line(*check);
    }
    return text;
}

}  // namespace burin::study
