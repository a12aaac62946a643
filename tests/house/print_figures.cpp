// SPDX-License-Identifier: MIT
// Prints the house's figures; exit status 1 when one misses its bar. scripts/check --house runs it.
#include <algorithm>
#include <cstdio>

#include "tests/house/house_figures.hpp"

int main() {
    const auto figures = burin::house::house_figures(BURIN_SOURCE_FOLDER);
    std::fputs(burin::house::table_of(figures).c_str(), stdout);
    return std::ranges::all_of(figures, &burin::house::Figure::reached) ? 0 : 1;
}
