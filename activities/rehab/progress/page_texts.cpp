// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/page_texts.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "base/assets.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "base/toml_table.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

constexpr std::string_view kLanguages = "languages";

std::filesystem::path languages_folder() { return assets_folder() / kLanguages; }

// Returns the words in braces: of "{runs} runs" "runs".
std::set<std::string> words_of(std::string_view text) {
    std::set<std::string> words;
    for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
        const std::size_t end = text.find('}', at);
        if (end == std::string_view::npos) break;
        words.emplace(text.substr(at + 1, end - at - 1));
    }
    return words;
}

}  // namespace

std::vector<std::string> PageTexts::codes() {
    std::vector<std::string> codes;
    std::error_code error;
    for (std::filesystem::directory_iterator at(languages_folder(), error), end; !error && at != end;
         at.increment(error))
        if (at->path().extension() == ".toml") codes.push_back(at->path().stem().string());
    std::ranges::sort(codes);
    return codes;
}

std::string PageTexts::listed() {
    std::string list;
    for (const std::string& code : codes()) list += (list.empty() ? "" : ", ") + code;
    return list;
}

Result<PageTexts> PageTexts::in(const std::string& code) {
    const std::vector<std::string> known = codes();
    if (std::ranges::find(known, code) == known.end())
        return fail("--language " + code, "is none of the languages", "there are " + listed());
    Result<PageTexts> english = read(languages_folder() / (std::string(kUsual) + ".toml"), nullptr);
    if (!english || code == kUsual) return english;
    return read(languages_folder() / (code + ".toml"), &*english);
}

Result<PageTexts> PageTexts::read(const std::filesystem::path& file, const PageTexts* model) {
    const Result<std::string> text = read_text_file(file);
    if (!text) return std::unexpected(text.error());
    BURIN_TRY(table, parse_toml(*text, file.string()));
    TableReading reading{file.string()};
    PageTexts texts;
    texts.code_ = file.stem().string();
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        const auto value = node.value<std::string>();
        if (!value) {
            reading.refuse(node, name + " is no text", "write it in quotation marks");
            continue;
        }
        texts.texts_[name] = *value;
        if (model == nullptr) continue;
        const auto like = model->texts_.find(name);
        if (like == model->texts_.end())
            reading.refuse(node, name + " is no text of the page", "take it out; " + model->code_ + ".toml has all");
        else if (words_of(*value) != words_of(like->second))
            reading.refuse(node, name + " has other words in braces than \"" + like->second + "\"",
                           "use the same words, each in braces");
    }
    if (model != nullptr)
        for (const auto& [key, value] : model->texts_)
            if (!texts.has(key)) reading.add({"has no text " + key, file.string(), "translate \"" + value + "\""});
    BURIN_TRY_DO(reading.outcome());
    return texts;
}

const std::string& PageTexts::text(std::string_view key) const {
    static const std::string kNone;
    const auto found = texts_.find(key);
    BURIN_CHECK(found != texts_.end());
    return found != texts_.end() ? found->second : kNone;
}

std::string PageTexts::named(std::string_view name) const { return has(name) ? text(name) : std::string(name); }

std::string PageTexts::filled(std::string_view key, const Words& words) const {
    std::string_view rest = text(key);
    std::string filled;
    while (!rest.empty()) {
        const std::size_t at = rest.find('{'), end = rest.find('}', at);
        if (at == std::string_view::npos || end == std::string_view::npos) break;
        filled += rest.substr(0, at);
        const std::string_view word = rest.substr(at + 1, end - at - 1);
        const auto with = std::ranges::find(words, word, &Words::value_type::first);
        BURIN_CHECK(with != words.end());
        if (with != words.end()) filled += with->second;
        rest.remove_prefix(end + 1);
    }
    return filled.append(rest);
}

std::string PageTexts::number(double value, int decimals) const {
    if (!std::isfinite(value)) return "-";
    std::string text = formatted("%.*f", decimals, value);
    if (std::ranges::all_of(text, [](char c) { return c == '-' || c == '0' || c == '.'; }) && text[0] == '-')
        text.erase(0, 1);  // no -0
    if (const std::size_t point = text.find('.'); point != std::string::npos)
        text.replace(point, 1, this->text("decimal"));
    return text;
}

std::string PageTexts::date(const std::string& iso) const {
    if (iso.size() != 10) return iso;
    return filled("date", {{"year", iso.substr(0, 4)}, {"month", iso.substr(5, 2)}, {"day", iso.substr(8, 2)}});
}

}  // namespace burin::activities
