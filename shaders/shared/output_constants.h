// SPDX-License-Identifier: MIT
// The push constants of the output stage's shader for one target. The modes' numbers are those of StereoMode.
#ifndef BURIN_SHARED_OUTPUT_CONSTANTS_H
#define BURIN_SHARED_OUTPUT_CONSTANTS_H
#include "shaders/shared/glm_names.h"
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

#ifdef __cplusplus
#define BURIN_CONSTANT constexpr int
#else
#define BURIN_CONSTANT const int
#endif

BURIN_CONSTANT kModeSideBySide = 0;
BURIN_CONSTANT kModeSideBySideHalf = 1;
BURIN_CONSTANT kModeTopBottom = 2;
BURIN_CONSTANT kModeTopBottomHalf = 3;
BURIN_CONSTANT kModeRows = 4;
BURIN_CONSTANT kModeColumns = 5;
BURIN_CONSTANT kModeCheckerboard = 6;
BURIN_CONSTANT kModeRedCyan = 7;
BURIN_CONSTANT kModeGreenMagenta = 8;
BURIN_CONSTANT kModeAmberBlue = 9;
BURIN_CONSTANT kModeOneEye = 10;  // all modes that show one eye in a target

BURIN_CONSTANT kOutputSwap = 1;           // exchange the eyes
BURIN_CONSTANT kOutputEncode = 2;         // the target does not encode sRGB by itself
BURIN_CONSTANT kOutputWarp = 4;           // use picture_from_output
BURIN_CONSTANT kOutputBlend = 8;          // use blend
BURIN_CONSTANT kOutputRightEye = 16;      // kModeOneEye: show the right eye
BURIN_CONSTANT kOutputCodedOverlay = 32;  // the overlay's colours are sRGB values
BURIN_CONSTANT kOutputPhaseX = 64;        // the target's column 0 is the second eye's (columns, checkerboard)
BURIN_CONSTANT kOutputPhaseY = 128;       // likewise row 0 (rows, checkerboard)
BURIN_CONSTANT kOutputOverlay = 256;      // an overlay is present
BURIN_CONSTANT kOutputSamePixels = 512;   // kModeOneEye: the target has as many pixels as the eye's picture
// Flags that a pipeline is specialised for; the others are passed with each target.
BURIN_CONSTANT kOutputBuiltIn =
    kOutputEncode | kOutputWarp | kOutputBlend | kOutputCodedOverlay | kOutputOverlay | kOutputSamePixels;

struct OutputConstants {
    // Columns of the homography; w of the first: 1 / gamma, of the second: the curve of the blend.
    vec4 picture_from_output[3];
    vec4 blend;     // widths of the blend zones: left, right, top, bottom
    ivec4 overlay;  // x, y, width, height in pixels of an eye's picture; width 0: none
    ivec2 eye_size;
    ivec2 target_size;
    int flags;
    int unused;
};

BURIN_SHARED_END

#undef BURIN_CONSTANT
#ifdef __cplusplus
static_assert(sizeof(burin::shared::OutputConstants) == 104,
              "laid out as std430 does, and within the 128 bytes of push constants that every device has");
#endif
#endif
