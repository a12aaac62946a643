// SPDX-License-Identifier: MIT
// Draws with OpenSceneGraph as a user who cares for speed sets it up: vertex buffers and no display
// lists, 16-bit indices where they suffice, static data, one program with the shading constants in its
// text, back faces culled by the state, near and far planes not recomputed, one thread for update, cull
// and draw (separate threads cost processor time for handing over), the context kept current. Each eye
// is a camera with an absolute projection that draws into a texture; with several samples OpenSceneGraph
// resolves them into it, as it does for any user. Small-feature culling is on, as by default.
#include <osg/Camera>
#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/Program>
#include <osg/Shader>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "bench/frame/frame_peers.hpp"
#include "bench/frame/gl_frames.hpp"

namespace burin::bench {
namespace {

struct ProgramText {
    std::string vertex, fragment;
};

ProgramText program_text(const FrameLook& look, const FrameWay& way) {
    const std::string function = gl_light_function(look, way.light);
    if (way.lit_at == LitAt::pixels) {
        return {R"(#version 120
varying vec3 normal_eye, to_eye;
void main() {
    normal_eye = gl_NormalMatrix * gl_Normal;
    to_eye = -(gl_ModelViewMatrix * gl_Vertex).xyz;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)",
                "#version 120\nvarying vec3 normal_eye, to_eye;\n" + function +
                    "void main() { gl_FragColor = vec4(light_of(normalize(normal_eye), normalize(to_eye)) + " +
                    gl_dither(way.light) + ", 1.0); }\n"};
    }
    // Interpolated over the screen, as Burin does it, which spares a software driver three divisions a pixel.
    const std::string head =
        "#version 120\n#extension GL_EXT_gpu_shader4 : enable\nnoperspective varying vec3 light;\n";
    return {head + function + R"(
void main() {
    light = light_of(normalize(gl_NormalMatrix * gl_Normal), normalize(-(gl_ModelViewMatrix * gl_Vertex).xyz));
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)",
            head + "void main() { gl_FragColor = vec4(light + " + gl_dither(way.light) + ", 1.0); }\n"};
}

osg::ref_ptr<osg::PrimitiveSet> triangles_of(const FrameMesh& mesh) {
    const auto count = static_cast<unsigned>(mesh.indices.size());
    if (mesh.vertices.size() > 65536) return new osg::DrawElementsUInt(GL_TRIANGLES, count, mesh.indices.data());
    osg::ref_ptr<osg::DrawElementsUShort> small = new osg::DrawElementsUShort(GL_TRIANGLES, count);
    for (unsigned i = 0; i < count; ++i) (*small)[i] = static_cast<unsigned short>(mesh.indices[i]);
    return small;
}

osg::Vec3 osg_of(const Vec3f& v) { return {v.x, v.y, v.z}; }

osg::ref_ptr<osg::Geometry> geometry_of(const FrameMesh& mesh) {
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array, normals = new osg::Vec3Array;
    for (const FrameVertex& vertex : mesh.vertices) {
        positions->push_back(osg_of(vertex.position_world_m));
        normals->push_back(osg_of(vertex.normal_world));
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setDataVariance(osg::Object::STATIC);
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles_of(mesh));
    return geometry;
}

// Copies the bytes: both store the columns of glm contiguously.
osg::Matrixd osg_of(const Mat4& m) { return osg::Matrixd(glm::value_ptr(m)); }

class OsgSubject final : public FrameSubject {
public:
    OsgSubject(const FrameScene& scene, unsigned samples, OsgDrawables drawables, const FrameWay& way)
        : scene_(scene), samples_(samples), drawables_(drawables), way_(way) {}

    Result<void> open();
    std::string name() const override {
        return drawables_ == OsgDrawables::patches ? "OpenSceneGraph, patches" : "OpenSceneGraph, one drawable";
    }
    // With 4 samples its frames were measured to cost as much as
    // with 1: it is not known whether they are multisampled at all.
    std::string note() const override {
        return samples_ > 1 ? "its frames are not known to have the samples that were asked for" : "";
    }
    FrameWay way() const override { return way_; }
    Result<void> draw(const FrameStep& step) override;
    Result<StereoImage> picture() override;

private:
    osg::ref_ptr<osg::Group> surface();
    osg::ref_ptr<osg::Camera> eye_camera(int eye, osg::Node* surface);
    void change(const PatchChange& change);
    static void put(osg::Geometry& geometry, std::size_t place, const FrameVertex& vertex);

    const FrameScene& scene_;
    unsigned samples_;
    OsgDrawables drawables_;
    FrameWay way_;
    osg::ref_ptr<osg::GraphicsContext> context_;
    osg::ref_ptr<osgViewer::Viewer> viewer_;
    std::vector<osg::ref_ptr<osg::Geometry>> geometries_;
    std::array<osg::ref_ptr<osg::Camera>, 2> eyes_;
    std::array<osg::ref_ptr<osg::Texture2D>, 2> pictures_;
};

Result<void> OsgSubject::open() {
    osg::setNotifyLevel(osg::FATAL);
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = traits->height = 16;
    traits->pbuffer = true;
    traits->doubleBuffer = false;
    traits->vsync = false;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    context_ = osg::GraphicsContext::createGraphicsContext(traits);
    if (!context_) return fail("OpenSceneGraph", "opened no OpenGL context", "check that the display has GLX");

    const osg::ref_ptr<osg::Group> root = new osg::Group, drawn = surface();
    for (int eye = 0; eye < 2; ++eye) root->addChild(eye_camera(eye, drawn));
    viewer_ = new osgViewer::Viewer;
    viewer_->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_->setReleaseContextAtEndOfFrameHint(false);
    osg::Camera* camera = viewer_->getCamera();
    camera->setGraphicsContext(context_);
    camera->setViewport(0, 0, 16, 16);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    viewer_->setLightingMode(osg::View::NO_LIGHT);
    viewer_->setSceneData(root);
    viewer_->setCameraManipulator(nullptr);
    viewer_->realize();
    if (!viewer_->isRealized()) return fail("OpenSceneGraph", "could not open its viewer", "check the display");
    return {};
}

osg::ref_ptr<osg::Group> OsgSubject::surface() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    if (drawables_ == OsgDrawables::one)
        geometries_.push_back(geometry_of(scene_.whole));
    else
        for (const FrameMesh& patch : scene_.patches) geometries_.push_back(geometry_of(patch));
    for (const auto& geometry : geometries_) group->addChild(geometry);

    const ProgramText text = program_text(scene_.look, way_);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, text.vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, text.fragment));
    osg::StateSet* state = group->getOrCreateStateSet();
    state->setAttributeAndModes(program);
    state->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    return group;
}

osg::ref_ptr<osg::Camera> OsgSubject::eye_camera(int eye, osg::Node* surface) {
    const auto width = static_cast<int>(scene_.size.width), height = static_cast<int>(scene_.size.height);
    const auto at = static_cast<std::size_t>(eye);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(width, height);
    texture->setInternalFormat(GL_RGBA8);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    pictures_[at] = texture;

    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setRenderOrder(osg::Camera::PRE_RENDER, eye);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setViewport(0, 0, width, height);
    const Vec3& b = scene_.look.background;
    camera->setClearColor({static_cast<float>(b.x), static_cast<float>(b.y), static_cast<float>(b.z), 1.0f});
    camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    const unsigned samples = samples_ > 1 ? samples_ : 0;
    camera->attach(osg::Camera::COLOR_BUFFER, texture, 0, 0, false, samples, samples);
    camera->attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
    camera->addChild(surface);
    eyes_[at] = camera;
    return camera;
}

void OsgSubject::put(osg::Geometry& geometry, std::size_t place, const FrameVertex& vertex) {
    (*static_cast<osg::Vec3Array*>(geometry.getVertexArray()))[place] = osg_of(vertex.position_world_m);
    (*static_cast<osg::Vec3Array*>(geometry.getNormalArray()))[place] = osg_of(vertex.normal_world);
}

void OsgSubject::change(const PatchChange& change) {
    const bool patches = drawables_ == OsgDrawables::patches;
    osg::Geometry& geometry = *geometries_[patches ? change.patch : 0];
    const std::vector<std::uint32_t>& whole = scene_.whole_vertices[change.patch];
    for (std::size_t i = 0; i < change.vertices.size(); ++i) put(geometry, patches ? i : whole[i], change.vertices[i]);
    geometry.getVertexArray()->dirty();
    geometry.getNormalArray()->dirty();
    if (patches) geometry.dirtyBound();  // the whole surface's bound stays valid within the dent's depth
}

Result<void> OsgSubject::draw(const FrameStep& step) {
    for (const PatchChange& c : step.changes) change(c);
    const wall::Eyes eyes = wall::eyes_of(step.viewer);
    const std::array eye_world{eyes.left_world, eyes.right_world};
    for (std::size_t i = 0; i < 2; ++i) {
        const GlView view = gl_view(scene_, eye_world[i]);
        eyes_[i]->setViewMatrix(osg_of(view.eye_from_world));
        eyes_[i]->setProjectionMatrix(osg_of(view.clip_from_eye));
    }
    viewer_->frame();
    glFinish();
    return {};
}

Result<StereoImage> OsgSubject::picture() {
    StereoImage both;
    const std::array images{&both.left, &both.right};
    if (!context_->makeCurrent()) return fail("OpenSceneGraph", "lost its OpenGL context", "check the display");
    osg::State& state = *context_->getState();
    for (std::size_t i = 0; i < 2; ++i) {
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        state.applyTextureAttribute(0, pictures_[i]);
        image->readImageFromCurrentTexture(state.getContextID(), false, GL_UNSIGNED_BYTE);
        if (image->s() != static_cast<int>(scene_.size.width) || image->t() != static_cast<int>(scene_.size.height) ||
            image->getPixelFormat() != GL_RGBA) {
            return fail("OpenSceneGraph", "its picture cannot be read", "check the OpenGL driver");
        }
        *images[i] = image_of_gl(scene_.size, image->data(), scene_.size.width);
    }
    return both;
}

}  // namespace

Result<std::unique_ptr<FrameSubject>> open_osg(const FrameScene& scene, unsigned samples, OsgDrawables drawables,
                                               const FrameWay& way) {
    auto subject = std::make_unique<OsgSubject>(scene, samples, drawables, way);
    if (const auto done = subject->open(); !done) return std::unexpected(done.error());
    return subject;
}

}  // namespace burin::bench
