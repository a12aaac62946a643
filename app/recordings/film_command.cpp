// SPDX-License-Identifier: MIT
#include "app/recordings/film_command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "picture/png.hpp"
#include "renderer/film.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

struct FilmOptions {
    std::string folder, out;
    double pictures_a_second = 10.0;
};

// Returns the number in a name, for pictures such as 0.5.png and 12.png; those without one come first, by name.
double number_in(const fs::path& path) {
    const std::string name = path.stem().string();
    const std::size_t at = name.find_first_of("0123456789");
    return at == std::string::npos ? -1.0 : std::strtod(name.c_str() + at, nullptr);
}

Result<std::vector<fs::path>> pictures_in(const std::string& folder) {
    Result<std::vector<fs::path>> pictures = entries_of(folder);
    if (!pictures) return fail(folder, pictures.error().what, "name a folder with pictures");
    std::erase_if(*pictures, [](const fs::path& file) { return file.extension() != ".png"; });
    if (pictures->empty())
        return fail(folder, "holds no .png", "burin replay FILE --pictures FOLDER --every 0.1 makes some");
    std::ranges::sort(*pictures, [](const fs::path& a, const fs::path& b) {
        const double first = number_in(a), second = number_in(b);
        return first != second ? first < second : a < b;
    });
    return pictures;
}

Result<void> join_pictures(const FilmOptions& options) {
    // There it would be a picture of the next film, or take the place of one of this.
    const fs::path home = fs::path(options.out).parent_path();
    std::error_code ignored;
    if (fs::equivalent(home.empty() ? "." : home, options.folder, ignored))
        return fail(options.out, "lies in the folder of the pictures", "give a place outside it");
    const std::string ending = fs::path(options.out).extension().string();
    if (ending != ".png" && ending != ".apng")
        return fail(options.out, "is no name for an animated PNG", "let it end in .png or .apng");
    BURIN_TRY(pictures, pictures_in(options.folder));
    renderer::Film made(static_cast<std::uint16_t>(std::lround(1000.0 / options.pictures_a_second)));
    for (const fs::path& path : pictures) {
        BURIN_TRY(picture, picture::load_png(path));
        if (const auto added = made.add(picture); !added)
            return fail(path.string(), added.error().what, added.error().remedy);
    }
    BURIN_TRY(bytes, made.finish());
    BURIN_TRY_DO(write_file_atomically(options.out, bytes));
    std::printf("%s: %zu picture(s), %.1f MB\n", options.out.c_str(), made.pictures(),
                1e-6 * static_cast<double>(bytes.size()));
    return {};
}

CommandAction add_film(Command command) {
    const auto options = std::make_shared<FilmOptions>();
    FilmOptions& film = *options;
    command.option("FOLDER", film.folder, "Pictures as PNG, in the order of the numbers in their names").required();
    command.option("OUT", film.out, "The file: animated PNG").required();
    command.option("--rate", film.pictures_a_second, "How many pictures are shown a second")
        .within(0.1, 100.0)
        .show_default();
    return action([options] { return join_pictures(*options); });
}

}  // namespace

CommandRow film_row() { return {"film", "Join a folder's pictures into one that moves (animated PNG)", add_film}; }

}  // namespace burin::app
