// SPDX-License-Identifier: MIT
// Draws with VTK as a user who cares for speed sets it up: one polygon mapper whose buffers stay on the device, Phong
// interpolation with one directional scene light, back faces culled, light and clipping range not recomputed, no
// swapping of buffers. Both eyes are renderers side by side in one off-screen window, each with a camera whose
// projection is given. VTK's highlight is Phong's: an exponent of a quarter looks like Blinn's. VTK's own shaders light
// every pixel, with Gouraud's interpolation too; in the other ways the light is put into them as text
// (vtkShaderProperty), which is how a user of VTK does it.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include <array>

#include "bench/frame/frame_peers.hpp"
#include "bench/frame/gl_frames.hpp"

namespace burin::bench {
namespace {

class VtkSubject final : public FrameSubject {
public:
    VtkSubject(const FrameScene& scene, unsigned samples, const FrameWay& way, bool gouraud)
        : scene_(scene), samples_(samples), way_(way), gouraud_(gouraud) {}

    void open();
    std::string name() const override { return "VTK"; }
    std::string note() const override {
        return own_light() ? "Phong's highlight instead of Blinn's" : "its shaders are given this light";
    }
    FrameWay way() const override { return way_; }
    Result<void> draw(const FrameStep& step) override;
    Result<StereoImage> picture() override;

private:
    [[nodiscard]] bool own_light() const { return way_.lit_at == LitAt::pixels && way_.light == FrameLight::simple; }
    void make_surface();
    void replace_light();
    void make_eye(std::size_t eye);
    void aim(std::size_t eye, const Vec3& eye_world);

    const FrameScene& scene_;
    unsigned samples_;
    FrameWay way_;
    bool gouraud_;
    vtkNew<vtkFloatArray> positions_, normals_;
    vtkNew<vtkPoints> points_;
    vtkNew<vtkPolyData> data_;
    vtkNew<vtkPolyDataMapper> mapper_;
    vtkNew<vtkActor> actor_;
    vtkNew<vtkRenderWindow> window_;
    std::array<vtkNew<vtkRenderer>, 2> eyes_;
};

void VtkSubject::make_surface() {
    const auto vertices = static_cast<vtkIdType>(scene_.whole.vertices.size());
    for (vtkFloatArray* array : {positions_.Get(), normals_.Get()}) {
        array->SetNumberOfComponents(3);
        array->SetNumberOfTuples(vertices);
    }
    for (vtkIdType i = 0; i < vertices; ++i) {
        const FrameVertex& v = scene_.whole.vertices[static_cast<std::size_t>(i)];
        positions_->SetTypedTuple(i, &v.position_world_m.x);
        normals_->SetTypedTuple(i, &v.normal_world.x);
    }
    vtkNew<vtkCellArray> triangles;
    triangles->AllocateExact(static_cast<vtkIdType>(scene_.triangles()),
                             static_cast<vtkIdType>(scene_.whole.indices.size()));
    for (std::size_t t = 0; t < scene_.whole.indices.size(); t += 3) {
        const std::array<vtkIdType, 3> corners{scene_.whole.indices[t], scene_.whole.indices[t + 1],
                                               scene_.whole.indices[t + 2]};
        triangles->InsertNextCell(3, corners.data());
    }
    points_->SetData(positions_);
    data_->SetPoints(points_);
    data_->SetPolys(triangles);
    data_->GetPointData()->SetNormals(normals_);
    mapper_->SetInputData(data_);
    mapper_->ScalarVisibilityOff();
    actor_->SetMapper(mapper_);

    const FrameLook& look = scene_.look;
    vtkProperty* p = actor_->GetProperty();
    gouraud_ ? p->SetInterpolationToGouraud() : p->SetInterpolationToPhong();
    p->SetColor(look.surface.x, look.surface.y, look.surface.z);
    p->SetSpecularColor(1.0, 1.0, 1.0);
    p->SetAmbient(look.ambient);
    p->SetDiffuse(look.diffuse);
    p->SetSpecular(look.specular);
    p->SetSpecularPower(0.25 * look.exponent);
    p->BackfaceCullingOn();
    if (!own_light()) replace_light();
}

// Each tag is replaced before VTK sees it (the flag true) and once (false).
void VtkSubject::replace_light() {
    vtkShaderProperty* shaders = actor_->GetShaderProperty();
    const std::string function = gl_light_function(scene_.look, way_.light), dither = gl_dither(way_.light);
    const char* colour = "light_of(normalize(normalVCVSOutput), normalize(-vertexVC.xyz))";
    if (way_.lit_at == LitAt::vertices) {
        shaders->AddVertexShaderReplacement("//VTK::Light::Dec", true,
                                            "noperspective out vec3 lightVSOutput;\n" + function, false);
        shaders->AddVertexShaderReplacement(
            "//VTK::Light::Impl", true,
            "lightVSOutput = light_of(normalize(normalVCVSOutput), normalize(-vertexVCVSOutput.xyz));\n", false);
        shaders->AddFragmentShaderReplacement("//VTK::Light::Dec", true, "noperspective in vec3 lightVSOutput;\n",
                                              false);
        colour = "lightVSOutput";
    } else {
        shaders->AddFragmentShaderReplacement("//VTK::Light::Dec", true, function, false);
    }
    shaders->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                          std::string("gl_FragData[0] = vec4(") + colour + " + " + dither + ", 1.0);\n",
                                          false);
}

void VtkSubject::make_eye(std::size_t eye) {
    vtkRenderer* renderer = eyes_[eye];
    renderer->SetViewport(0.5 * static_cast<double>(eye), 0.0, 0.5 * static_cast<double>(eye + 1), 1.0);
    const FrameLook& look = scene_.look;
    renderer->SetBackground(look.background.x, look.background.y, look.background.z);
    renderer->AutomaticLightCreationOff();
    renderer->TwoSidedLightingOff();
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->PositionalOff();
    light->SetPosition(look.to_light_world.x, look.to_light_world.y, look.to_light_world.z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    renderer->AddLight(light);
    renderer->AddActor(actor_);
    window_->AddRenderer(renderer);
}

void VtkSubject::open() {
    make_surface();
    window_->SetOffScreenRendering(1);
    window_->SetSize(2 * static_cast<int>(scene_.size.width), static_cast<int>(scene_.size.height));
    window_->SetMultiSamples(samples_ > 1 ? static_cast<int>(samples_) : 0);
    window_->SwapBuffersOff();
    for (std::size_t eye = 0; eye < 2; ++eye) make_eye(eye);
}

void VtkSubject::aim(std::size_t eye, const Vec3& eye_world) {
    const GlView view = gl_view(scene_, eye_world);
    vtkNew<vtkMatrix4x4> clip_from_eye;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            clip_from_eye->SetElement(row, column, view.clip_from_eye[column][row]);
    vtkCamera* camera = eyes_[eye]->GetActiveCamera();
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetFocalPoint(eye_world.x, eye_world.y, eye_world.z - 1.0);
    camera->SetPosition(eye_world.x, eye_world.y, eye_world.z);
    camera->SetClippingRange(scene_.near_m, scene_.far_m);
    camera->SetUseExplicitProjectionTransformMatrix(true);
    camera->SetExplicitProjectionTransformMatrix(clip_from_eye);
}

Result<void> VtkSubject::draw(const FrameStep& step) {
    for (const PatchChange& change : step.changes) {
        const std::vector<std::uint32_t>& whole = scene_.whole_vertices[change.patch];
        for (std::size_t i = 0; i < change.vertices.size(); ++i) {
            positions_->SetTypedTuple(whole[i], &change.vertices[i].position_world_m.x);
            normals_->SetTypedTuple(whole[i], &change.vertices[i].normal_world.x);
        }
    }
    if (!step.changes.empty()) {
        positions_->Modified();
        normals_->Modified();
        points_->Modified();
        data_->Modified();
    }
    const wall::Eyes eyes = wall::eyes_of(step.viewer);
    aim(0, eyes.left_world);
    aim(1, eyes.right_world);
    window_->Render();
    window_->WaitForCompletion();
    return {};
}

Result<StereoImage> VtkSubject::picture() {
    const ImageSize size = scene_.size;
    vtkNew<vtkUnsignedCharArray> pixels;
    if (window_->GetRGBACharPixelData(0, 0, 2 * static_cast<int>(size.width) - 1, static_cast<int>(size.height) - 1, 0,
                                      pixels) == 0 ||
        pixels->GetNumberOfTuples() != static_cast<vtkIdType>(2 * size.width * size.height)) {
        return fail("VTK", "its picture cannot be read", "check the OpenGL driver");
    }
    const unsigned char* rgba = pixels->GetPointer(0);
    return StereoImage{image_of_gl(size, rgba, 2 * size.width),
                       image_of_gl(size, rgba + std::size_t{4} * size.width, 2 * size.width)};
}

}  // namespace

bool has_frame_peers() { return true; }

Result<std::unique_ptr<FrameSubject>> open_vtk(const FrameScene& scene, unsigned samples, const FrameWay& way,
                                               bool gouraud) {
    auto subject = std::make_unique<VtkSubject>(scene, samples, way, gouraud);
    subject->open();
    return subject;
}

}  // namespace burin::bench
