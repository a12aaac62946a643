// SPDX-License-Identifier: MIT
// How precise a mesh file's coordinates are: as many digits as its numbers have, or as a float or a double where these
// have fewer. Two corners that a program computed in two ways, such as both ends of a seam, differ by some of the last
// of these digits. Internal to geometry/.
#pragma once

#include <string_view>

namespace burin::geometry {

class CoordinatePrecision {
public:
    // Take note of a coordinate: of a text, with its word; of a binary file.
    void see(std::string_view word, double value);
    void see(double value) { all_floats_ = all_floats_ && value == static_cast<double>(static_cast<float>(value)); }

    // Returns the distance, in numbers of the file, up to which corners count as one where the surface is open between
    // them: `largest` is the largest absolute coordinate. It follows from the last place in which this number is
    // written: one of a text's decimals, two of a float, along each axis; of doubles, which programs compute from
    // others, 512. Texts of few digits somebody has typed as they are: then 512 of a double as well, which is what
    // differs by no more than arithmetic does.
    [[nodiscard]] double weld_tolerance(double largest) const;

private:
    int digits_ = 0;  // the most of any word of a text; 0: none is a text
    bool all_floats_ = true;
};

}  // namespace burin::geometry
