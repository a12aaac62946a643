// SPDX-License-Identifier: MIT
#include "activities/rehab/rehab_settings.hpp"

#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "base/toml_table.hpp"

namespace burin::activities {
namespace {

std::string known_colours() {
    std::string text;
    for (const BallKind& kind : ball_kinds()) text += (text.empty() ? "" : ", ") + std::string(kind.name);
    return text;
}

// Reads a count: a whole number.
void read_count(TableReader& table, const char* key, unsigned& count) {
    const auto value = table.number(key);
    if (!value) return;
    if (*value < 0.0 || *value != std::floor(*value) || *value > std::numeric_limits<int>::max())
        return table.refuse(key, formatted("is %g", *value), "write a whole number, not below 0");
    count = static_cast<unsigned>(*value);
}

BallSettings ball_in(TableReading& reading, const toml::table* given) {
    BallSettings ball;
    TableReader table(reading, given, "[ball]");
    if (const auto colour = table.text("colour")) {
        if (const auto known = ball_named(*colour))
            ball.colour = *known;
        else
            table.refuse("colour", "is " + *colour, "there are " + known_colours());
    }
    read_count(table, "level", ball.level);
    read_count(table, "repetitions", ball.repetitions);
    if (const auto hold_s = table.number("hold_s")) ball.hold_s = *hold_s;
    if (const auto limit_s = table.number("time_limit_s")) ball.time_limit_s = *limit_s;
    table.refuse_unknown();
    for (const Error& problem : problems(ball)) table.refuse(problem.where.c_str(), problem.what, problem.remedy);
    return ball;
}

}  // namespace

ReadSettings parse_rehab_settings(std::string_view text, const std::string& name) {
    ReadSettings read;
    const Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) {
        read.errors.push_back(parsed.error());
        return read;
    }
    TableReading reading{name};
    TableReader file(reading, &*parsed, "the file");
    read.settings.ball = ball_in(reading, file.table("ball"));
    file.refuse_unknown();
    read.errors = std::move(reading.errors);
    return read;
}

std::string settings_text(const RehabSettings& settings) {
    const BallSettings& ball = settings.ball;
    return formatted("[ball]\ncolour = \"%s\"\nlevel = %u\nrepetitions = %u\nhold_s = %.17g\ntime_limit_s = %.17g\n",
                     std::string(kind_of(ball.colour).name).c_str(), ball.level, ball.repetitions, ball.hold_s,
                     ball.time_limit_s);
}

}  // namespace burin::activities
