// SPDX-License-Identifier: MIT
#include "bench/frame/gl_frames.hpp"

#include <array>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "wall/projection.hpp"

namespace burin::bench {
namespace {

std::string constant(const char* name, double value) {
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "const float %s = %.8f;\n", name, value);
    return text.data();
}
std::string constant(const char* name, const Vec3& v) {
    std::array<char, 192> text{};
    std::snprintf(text.data(), text.size(), "const vec3 %s = vec3(%.8f, %.8f, %.8f);\n", name, v.x, v.y, v.z);
    return text.data();
}

constexpr const char* kSimple = R"(
vec3 light_of(vec3 n, vec3 v) {
    vec3 h = normalize(v + to_light);
    float lit = ambient + diffuse * max(dot(n, to_light), 0.0);
    return lit * surface + specular * pow(max(dot(n, h), 0.0), exponent);
}
)";

constexpr const char* kBurins = R"(
vec3 ambient_light(vec3 n) { return mix(ground, sky, 0.5 + 0.5 * n.y); }
float highlight(vec3 n, vec3 v, vec3 l) {
    vec3 h = normalize(v + l);
    float nl = max(dot(n, l), 0.0), nv = max(dot(n, v), 0.001), nh = max(dot(n, h), 0.0), vh = max(dot(v, h), 0.0);
    float a = roughness * roughness, a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    float visibility = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    float one_minus = 1.0 - vh, squared = one_minus * one_minus;
    float fresnel = 0.04 + 0.96 * squared * squared * one_minus;
    return nl * a2 / (d * d) * visibility * 0.25 * fresnel;
}
vec3 light_of(vec3 n, vec3 v) {
    float nl = dot(n, to_light);
    vec3 key = nl > 0.0 ? lamp_colour : vec3(0.0);
    vec3 c = surface * (key * max(nl, 0.0) + ambient_light(n));
    c += key * highlight(n, v, to_light) * gloss;
    vec3 mirrored = reflect(-v, n);
    float grazing = 1.0 - max(dot(n, v), 0.0);
    float fresnel = 0.04 + 0.5 * grazing * grazing * grazing * (1.0 - 0.6 * roughness);
    float lamp = smoothstep(0.75 - 0.3 * roughness, 0.98, dot(mirrored, to_light));
    c += (ambient_light(mirrored) + key * lamp * 0.35) * fresnel * gloss;
    vec3 soft = 1.0 - 0.3 * exp(-(max(c, vec3(0.7)) - 0.7) / 0.3);
    c = mix(c, soft, vec3(greaterThan(c, vec3(0.7))));
    vec3 bright = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return mix(12.92 * c, bright, vec3(greaterThan(c, vec3(0.0031308))));
}
)";

}  // namespace

GlView gl_view(const FrameScene& scene, const Vec3& eye_world) {
    Mat4 gl_from_vulkan(1.0);
    gl_from_vulkan[1][1] = -1.0;
    gl_from_vulkan[2][2] = 2.0;
    gl_from_vulkan[3][2] = -1.0;  // z' = 2 z - w
    const Mat4 clip_from_world =
        gl_from_vulkan * off_axis_projection(scene.screen, eye_world, scene.near_m, scene.far_m);
    return {glm::translate(Mat4(1.0), -eye_world), clip_from_world * glm::translate(Mat4(1.0), eye_world)};
}

Image image_of_gl(ImageSize size, const unsigned char* rgba, std::size_t row_pixels) {
    Image image{size, {}};
    image.rgba.reserve(std::size_t{4} * size.width * size.height);
    for (std::uint32_t y = size.height; y-- > 0;) {
        const unsigned char* row = rgba + 4 * row_pixels * y;
        image.rgba.insert(image.rgba.end(), row, row + std::size_t{4} * size.width);
    }
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

std::string gl_light_function(const FrameLook& look, FrameLight light) {
    if (light == FrameLight::simple) {
        return constant("to_light", look.to_light_world) + constant("surface", look.surface) +
               constant("ambient", look.ambient) + constant("diffuse", look.diffuse) +
               constant("specular", look.specular) + constant("exponent", look.exponent) + kSimple;
    }
    const BurinsLight b = burins_light(look);
    return constant("to_light", b.to_light_world) + constant("lamp_colour", b.light) + constant("sky", b.sky) +
           constant("ground", b.ground) + constant("surface", b.surface) + constant("roughness", b.roughness) +
           constant("gloss", b.gloss) + kBurins;
}

std::string gl_dither(FrameLight light) {
    if (light == FrameLight::simple) return "vec3(0.0)";
    return "vec3((fract(dot(gl_FragCoord.xy, vec2(0.5, 0.75)) - 0.625) * (4.0 / 3.0) - 0.5) / 255.0)";
}

}  // namespace burin::bench
