// SPDX-License-Identifier: MIT
// Compares what bash completes with the manual, whose options CLI11 formats by itself, for every command and option of
// the program, and runs bash on some of each kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

// An option as the manual has it.
struct ManualOption {
    std::vector<std::string> names;  // "-h", "--help"
    std::string value;               // what stands behind the names; empty: a flag
};
using ManualOptions = std::map<std::string, std::vector<ManualOption>>;  // by the path of commands: "/study/run"

// Takes roff's escapes out of a line.
std::string plain(const std::string& roff) {
    std::string text;
    for (std::size_t i = 0; i < roff.size(); ++i) {
        if (roff[i] != '\\') {
            text += roff[i];
            continue;
        }
        const char c = i + 1 < roff.size() ? roff[++i] : ' ';
        if (c == 'f')
            ++i;  // a font and its letter
        else if (c == '-')
            text += '-';
        else if (c == 'e')
            text += '\\';
    }
    return text;
}

std::vector<std::string> split(const std::string& text, const std::string& at) {
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (std::size_t to = text.find(at); to != std::string::npos; to = text.find(at, from)) {
        parts.push_back(text.substr(from, to - from));
        from = to + at.size();
    }
    parts.push_back(text.substr(from));
    return parts;
}

// Reads the options of a page, whose sections of commands are in capitals: "BURIN STUDY RUN".
void read_page(const std::string& page, std::string path, ManualOptions& to) {
    std::istringstream lines(page);
    bool is_option = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(".SH \"BURIN ")) {
            path.clear();
            for (const std::string& word : split(plain(line.substr(11, line.size() - 12)), " ")) path += "/" + word;
            std::ranges::transform(path, path.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
        }
        if (is_option && line.starts_with("\\fB")) {
            const std::size_t end = line.find("\\fR");
            ManualOption option;
            option.names = split(plain(line.substr(3, end - 3)), ", ");
            option.value = plain(line.substr(end + 3));
            // One that may also be given by its place has that place's name first.
            std::erase_if(option.names, [](const std::string& name) { return !name.starts_with('-'); });
            if (!option.names.empty()) to[path].push_back(option);
        }
        is_option = line == ".TP";
    }
}

std::set<std::string> words_in(const std::string& text) {
    std::istringstream in(text);
    std::set<std::string> words;
    for (std::string word; in >> word;) words.insert(word);
    return words;
}

// Returns what stands between `name` and the next quote.
std::string quoted_after(const std::string& line, const std::string& name) {
    const std::size_t from = line.find(name + "='");
    if (from == std::string::npos) return "";
    const std::size_t begin = from + name.size() + 2;
    return line.substr(begin, line.find('\'', begin) - begin);
}

class Completion : public testing::Test {
protected:
    static void SetUpTestSuite() {
        place_ = std::make_unique<Workplace>();
        const auto written = place_->run(std::string(kBurinCommand) + " --write-manual .");
        ASSERT_EQ(written.status, 0) << written.output;
        bash_ = place_->read("bash/burin");
        for (const auto& entry : std::filesystem::directory_iterator(*place_ / "man")) {
            const std::string name = entry.path().stem().string();
            read_page(place_->read("man/" + entry.path().filename().string()),
                      name == "burin" ? "" : "/" + name.substr(std::string("burin-").size()), options_);
        }
    }
    static void TearDownTestSuite() { place_.reset(); }
    // The line of the case for a path, or for a path and an option.
    static std::string case_of(const std::string& what) {
        const std::size_t from = bash_.find("\n    '" + what + "') ");
        return from == std::string::npos ? "" : bash_.substr(from + 1, bash_.find('\n', from + 1) - from - 1);
    }

    static inline std::unique_ptr<Workplace> place_;
    static inline std::string bash_;
    static inline ManualOptions options_;
};

}  // namespace

TEST_F(Completion, KnowsOfEveryOptionOfEveryCommandWhetherItTakesAValue) {
    std::size_t flags = 0, with_values = 0;
    for (const auto& [path, options] : options_) {
        const std::string line = case_of(path);
        ASSERT_FALSE(line.empty()) << "no completion of " << path;
        const std::set<std::string> completed_flags = words_in(quoted_after(line, " flags")),
                                    completed_options = words_in(quoted_after(line, " options"));
        std::size_t names = 0;
        for (const ManualOption& option : options)
            for (const std::string& name : option.names) {
                ++names;
                const bool is_flag = option.value.empty();
                (is_flag ? flags : with_values) += 1;
                EXPECT_EQ(completed_flags.contains(name), is_flag) << path << " " << name << option.value;
                EXPECT_EQ(completed_options.contains(name), !is_flag) << path << " " << name << option.value;
            }
        EXPECT_EQ(completed_flags.size() + completed_options.size(), names) << path << " offers what is no option";
    }
    EXPECT_GT(options_.size(), 20u);
    EXPECT_GT(flags, 40u);
    EXPECT_GT(with_values, 100u);
}

TEST_F(Completion, OffersTheWordsOfEveryOptionThatTakesWordsAndNoFiles) {
    std::size_t with_words = 0;
    for (const auto& [path, options] : options_)
        for (const ManualOption& option : options) {
            const std::size_t begin = option.value.find('{'), end = option.value.find('}');
            if (begin == std::string::npos || end == std::string::npos) continue;
            std::set<std::string> words;
            for (std::string word : split(option.value.substr(begin + 1, end - begin - 1), ",")) {
                std::erase(word, ' ');
                words.insert(word);
            }
            for (const std::string& name : option.names) {
                const std::string line = case_of(path + " " + name);
                EXPECT_EQ(words_in(quoted_after(line, " words")), words) << path << " " << name;
                EXPECT_TRUE(line.contains("files=no")) << path << " " << name;
                ++with_words;
            }
        }
    EXPECT_GT(with_words, 10u);
}

// Asks bash itself: neither commands nor options are offered behind an option with a value, and all behind a flag.
TEST_F(Completion, BehindAnOptionWithAValueNoOptionIsOfferedAndBehindAFlagAllAre) {
    std::string script =
        "source bash/burin\ncomplete_words() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); "
        "COMPREPLY=(); _burin; echo \"${COMPREPLY[*]}\"; }\n";
    std::vector<std::pair<std::string, bool>> asked;  // what was asked, and whether options are to be offered
    for (const auto& [path, options] : options_) {
        std::string words = "burin";
        for (const std::string& word : split(path, "/"))
            if (!word.empty()) words += " " + word;
        bool has_flag = false, has_value = false;
        for (const ManualOption& option : options) {
            bool& had = option.value.empty() ? has_flag : has_value;
            if (std::exchange(had, true)) continue;
            const std::string& name = option.names.back();
            script += "complete_words " + words + " " + name + " -\n";
            asked.emplace_back(words + " " + name, option.value.empty());
        }
        if (asked.size() > 16) break;
    }
    place_->write("ask.sh", script);
    const auto outcome = place_->run("bash ask.sh");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const std::vector<std::string> answers = split(outcome.output, "\n");
    ASSERT_EQ(answers.size(), asked.size() + 1) << outcome.output;
    for (std::size_t i = 0; i < asked.size(); ++i)
        EXPECT_EQ(answers[i].contains("--"), asked[i].second) << asked[i].first << ": " << answers[i];
}

}  // namespace burin::app
