#include "limit_tree.hpp"

#include "limit_shapes.hpp"

namespace raytracer::limit {
namespace {

class Builder {
 public:
  void add_spheres(const Part& part) {
    if (!part.spheres.empty()) attach(sphere_geometry(device_, part.spheres), part.surface);
  }

  void add_quads(const Part& part) {
    if (!part.quads.empty()) attach(quad_geometry(device_, part.quads), part.surface);
  }

  void add_mesh(const Part& part) {
    if (part.triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    share(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, part.points);
    share(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, part.triangles);
    attach(geometry, part.surface);
  }

  Tree commit() {
    rtcCommitScene(tree_.scene);
    return std::move(tree_);
  }

  Builder() { rtcSetSceneFlags(tree_.scene, RTC_SCENE_FLAG_ROBUST); }

 private:
  template <class Element>
  static void share(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                    const std::vector<Element>& elements) {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, elements.data(), 0, sizeof(Element),
                               elements.size());
  }

  void attach(RTCGeometry geometry, const Surface& surface) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree_.scene, geometry, static_cast<unsigned>(tree_.surfaces.size()));
    rtcReleaseGeometry(geometry);
    tree_.surfaces.push_back(surface);
  }

  RTCDevice device_ = rtcNewDevice(nullptr);
  Tree tree_{rtcNewScene(device_), {}};
};

}  // namespace

Tree build_tree(const World& world) {
  Builder builder;
  for (const Part& part : world.parts) {
    builder.add_spheres(part);
    builder.add_quads(part);
    builder.add_mesh(part);
  }
  return builder.commit();
}

}  // namespace raytracer::limit
