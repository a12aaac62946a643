// SPDX-License-Identifier: MIT
// The arithmetic of the output stage: from the two eyes' pictures to what a display shows in each stereo mode. All
// mixing is done in linear light.
//
// C++ evaluates it in double precision (renderer/output/compose.cpp), the device in single, with the driver's own pow
// and its own decoding of sRGB texels. Integers, and with them every mode that copies pixels, agree to the bit; where
// light is mixed the results lie within one step of 255 of each other (tests/renderer/output/output_gpu.cpp).
#ifndef BURIN_SHARED_OUTPUT_RULES_H
#define BURIN_SHARED_OUTPUT_RULES_H
#include "shaders/shared/output_constants.h"
#include "shaders/shared/srgb.h"

BURIN_SHARED_BEGIN

// An eye's part of the target, and a pixel's position in it.
struct OutputCell {
    int x;  // within the part
    int y;
    int width;  // of the part
    int height;
    int taps_x;  // number of the eye's pixels that are averaged into one, each way
    int taps_y;
    int eye;  // 0: left
    bool shown;
};

BURIN_FN bool has_flag(int flags, int flag) { return (flags & flag) != 0; }

BURIN_FN OutputCell output_cell(int mode, int flags, int x, int y, int width, int height) {
    OutputCell cell;
    cell.x = x;
    cell.y = y;
    cell.width = width;
    cell.height = height;
    cell.taps_x = 1;
    cell.taps_y = 1;
    cell.eye = 0;
    cell.shown = true;
    int phase_x = has_flag(flags, kOutputPhaseX) ? 1 : 0;
    int phase_y = has_flag(flags, kOutputPhaseY) ? 1 : 0;
    switch (mode) {
        case kModeSideBySide:
        case kModeSideBySideHalf:
            cell.width = max(1, width / 2);
            cell.eye = x / cell.width;
            cell.x = x - cell.eye * cell.width;
            cell.shown = cell.eye < 2;
            if (mode == kModeSideBySideHalf) cell.taps_x = 2;
            break;
        case kModeTopBottom:
        case kModeTopBottomHalf:
            cell.height = max(1, height / 2);
            cell.eye = y / cell.height;
            cell.y = y - cell.eye * cell.height;
            cell.shown = cell.eye < 2;
            if (mode == kModeTopBottomHalf) cell.taps_y = 2;
            break;
        case kModeRows: cell.eye = (y + phase_y) & 1; break;
        case kModeColumns: cell.eye = (x + phase_x) & 1; break;
        case kModeCheckerboard: cell.eye = (x + y + phase_x + phase_y) & 1; break;
        case kModeOneEye: cell.eye = has_flag(flags, kOutputRightEye) ? 1 : 0; break;
    }
    if (has_flag(flags, kOutputSwap)) cell.eye = 1 - cell.eye;
    return cell;
}

// Maps pixel p of n to one of m, in integers: the one that holds the middle of p; p itself when n equals m.
BURIN_FN int fitted(int p, int n, int m) {
    return int(((whole(2) * whole(p) + whole(1)) * whole(m)) / (whole(2) * whole(n)));
}

// Returns the pixel of an eye's picture, `size` pixels long, that one tap reads for the cell's pixel `at` of `count`.
BURIN_FN int copied_pixel(int at, int count, int taps, int tap, int size) {
    return min(fitted(at, count, max(1, size / taps)) * taps + tap, size - 1);
}

BURIN_FN bool is_anaglyph_mode(int mode) { return mode >= kModeRedCyan && mode <= kModeAmberBlue; }

// The colour matrices of the anaglyph modes: the light that reaches each eye through its filter is, by least squares
// over the spectra of filters, displays and eyes, as near as possible to what that eye should see. White is preserved
// to within 0.2 %.
// Method: Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001. Numbers: the matrices that the
// author publishes for LCD displays (Dubois, "Conversion of a stereo pair to anaglyph with the least-squares projection
// method", University of Ottawa, 2009, https://www.site.uottawa.ca/~edubois/anaglyph/): red-cyan, green-magenta and
// amber-blue. The red-cyan pair is the one for glasses and monitors in general, from the same source.
// By rows, as published: the weights of the picture's channels in red, green and blue of the result; for each mode
// first the left picture's rows, then the right's.
BURIN_TABLE real3 kAnaglyphRows[18] = {
    real3(0.437, 0.449, 0.164),    real3(-0.062, -0.062, -0.024), real3(-0.048, -0.050, -0.017),
    real3(-0.011, -0.032, -0.007), real3(0.377, 0.761, 0.009),    real3(-0.026, -0.093, 1.234),
    real3(-0.062, -0.158, -0.039), real3(0.284, 0.668, 0.143),    real3(-0.015, -0.027, 0.021),
    real3(0.529, 0.705, 0.024),    real3(-0.016, -0.015, -0.065), real3(0.009, 0.075, 0.937),
    real3(1.062, -0.205, 0.299),   real3(-0.026, 0.908, 0.068),   real3(-0.038, -0.173, 0.022),
    real3(-0.016, -0.123, -0.017), real3(0.006, 0.062, -0.017),   real3(0.094, 0.185, 0.911)};
BURIN_FN int anaglyph_row(int mode, int picture) { return 6 * (mode - kModeRedCyan) + 3 * picture; }

// Returns what the light of the left (0) or the right (1) picture adds to the light shown; the sum may leave 0 to 1.
BURIN_FN real3 anaglyph_light(int mode, int picture, real3 light) {
    int row = anaglyph_row(mode, picture);
    return real3(dot(kAnaglyphRows[row], light), dot(kAnaglyphRows[row + 1], light),
                 dot(kAnaglyphRows[row + 2], light));
}

// Applies a homography, given by its columns, to a position and returns the position in the picture. Positions behind
// the picture's horizon map far outside it.
BURIN_FN real2 warped_place(real3 column0, real3 column1, real3 column2, real2 place) {
    real3 q = column0 * place.x + column1 * place.y + column2;
    return q.z > 1e-9 ? real2(q.x / q.z, q.y / q.z) : real2(-1e6, -1e6);
}

// Returns a position from 0 to 1 in pixels of a picture `size` pixels long: the integer part is the first of the two
// pixels it lies between, the fraction the distance past that pixel's middle. Far outside the picture both pixels are
// outside.
BURIN_FN real between_pixels(real place, int size) {
    return clamp(place * real(size) - real(0.5), real(-2.0), real(size) + real(1.0));
}

// Returns the weight of the first (0) or the second (1) of two neighbouring pixels, `behind` the first one's middle.
BURIN_FN real weight_between(real behind, int which) { return which == 0 ? real(1.0) - behind : behind; }

// Returns the share of its light that a picture gives near one of its edges (EdgeFade in wall/output_settings.hpp).
BURIN_FN real share_near_edge(real distance_to_edge, real width, real curve) {
    if (width <= real(0.0) || distance_to_edge >= width) return real(1.0);
    real t = max(real(0.0), distance_to_edge / width);
    return t < real(0.5) ? real(0.5) * pow(real(2.0) * t, curve)
                         : real(1.0) - real(0.5) * pow(real(2.0) * (real(1.0) - t), curve);
}
BURIN_FN real blended_share(real2 place, real left, real right, real top, real bottom, real curve) {
    return share_near_edge(place.x, left, curve) * share_near_edge(real(1.0) - place.x, right, curve) *
           share_near_edge(place.y, top, curve) * share_near_edge(real(1.0) - place.y, bottom, curve);
}

// Converts a premultiplied colour whose channels are sRGB values to linear light.
BURIN_FN real3 light_of_coded(real3 coded, real alpha) {
    if (alpha <= real(0.0)) return coded;
    return linear_of(min(coded / alpha, real3(1.0))) * alpha;
}
// Composites a premultiplied colour over a picture.
BURIN_FN real3 laid_over(real3 above, real alpha, real3 light) { return above + (real(1.0) - alpha) * light; }

BURIN_SHARED_END
#endif
