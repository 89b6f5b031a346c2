// How FBX places a node, against the SDK's formula as a product of matrices.
#include <import/fbx/transform.h>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <random>

namespace mobbscope {
namespace {

glm::dmat4 moved(const glm::dvec3& by) { return glm::translate(glm::dmat4(1), by); }
glm::dmat4 scaled(const glm::dvec3& by) { return glm::scale(glm::dmat4(1), by); }

glm::dmat4 about(int axis, double degrees) {
    glm::dvec3 direction(0);
    direction[axis] = 1;
    return glm::rotate(glm::dmat4(1), glm::radians(degrees), direction);
}

/// The axes in the order of RotationOrder's names: the first one is turned about first.
glm::dmat4 euler(const glm::dvec3& degrees, const char* order) {
    glm::dmat4 out(1);
    for (const char* axis = order; *axis; ++axis) out = about(*axis - 'X', degrees[*axis - 'X']) * out;
    return out;
}

constexpr const char* kOrders[] = {"XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX"};

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
    }
    return most;
}

glm::dmat4 matrix(const TranslationRotationScale& local) {
    return moved(local.translation) * glm::mat4_cast(local.rotation) * scaled(local.scale);
}

class FbxTransforms : public ::testing::Test {
  protected:
    glm::dvec3 vector(double most) {
        std::uniform_real_distribution<double> in(-most, most);
        return {in(random_), in(random_), in(random_)};
    }

    FbxTransform transform() {
        FbxTransform out;
        for (glm::dvec3& property : out.properties) property = vector(10);
        out[FbxProperty::scaling] = glm::dvec3(1.5) + vector(1);
        for (const FbxProperty angles : {FbxProperty::rotation, FbxProperty::pre_rotation, FbxProperty::post_rotation})
            out[angles] = vector(180);
        return out;
    }

    std::mt19937 random_{20261125};
};

TEST_F(FbxTransforms, OrdersOfRotationAreThoseOfTheirNames) {
    for (int order = 0; order < 6; ++order) {
        const glm::dvec3 degrees = vector(180);
        EXPECT_LT(difference(glm::mat4_cast(fbx_rotation(degrees, order)), euler(degrees, kOrders[order])), 1e-12)
            << kOrders[order];
    }
    EXPECT_EQ(fbx_rotation({10, 20, 30}, 6), fbx_rotation({10, 20, 30}, 0)) << "spheric: not as angles";
}

TEST_F(FbxTransforms, AnglesLeadBackToTheRotation) {
    for (int round = 0; round < 1000; ++round) {
        const int order = round % 6;
        glm::dvec3 degrees = vector(180);
        if (round % 5 == 0) degrees[kOrders[order][1] - 'X'] = round % 2 == 0 ? 90 : -90;  // gimbal lock
        const glm::dquat rotation = fbx_rotation(degrees, order);
        const glm::dquat again = fbx_rotation(fbx_angles(rotation, order), order);
        EXPECT_GT(std::abs(glm::dot(rotation, again)), 1 - 1e-12) << kOrders[order] << " round " << round;
    }
}

TEST_F(FbxTransforms, LocalIsTheProductOfTheSdk) {
    using enum FbxProperty;
    for (int round = 0; round < 100; ++round) {
        FbxTransform t = transform();
        t.rotation_order = round % 6;
        const glm::dmat4 product =
            moved(t[FbxProperty::translation]) * moved(t[rotation_offset]) * moved(t[rotation_pivot]) *
            euler(t[pre_rotation], "XYZ") * euler(t[rotation], kOrders[t.rotation_order]) *
            glm::inverse(euler(t[post_rotation], "XYZ")) * moved(-t[rotation_pivot]) * moved(t[scaling_offset]) *
            moved(t[scaling_pivot]) * scaled(t[FbxProperty::scaling]) * moved(-t[scaling_pivot]);
        EXPECT_LT(difference(matrix(t.local()), product), 1e-10) << round;
    }
}

TEST_F(FbxTransforms, WithoutRotationSpaceAnglesAloneCount) {
    FbxTransform t = transform();
    t.rotation_order = 5;
    t.has_rotation_space = false;
    EXPECT_LT(difference(glm::mat4_cast(t.local().rotation), euler(t[FbxProperty::rotation], "XYZ")), 1e-12);
}

TEST_F(FbxTransforms, ScaleIsInheritedInThreeWays) {
    FbxTransform top;
    top[FbxProperty::scaling] = {2, 1, 1};
    FbxTransform middle;
    middle[FbxProperty::translation] = {1, 0, 0};
    middle[FbxProperty::rotation] = {0, 0, 90};
    middle[FbxProperty::scaling] = {1, 3, 1};
    FbxTransform end;
    end[FbxProperty::translation] = {1, 1, 0};
    const auto place = [&](FbxInherit inherit_middle, FbxInherit inherit_end) {
        middle.inherit = inherit_middle;
        end.inherit = inherit_end;
        const FbxGlobal first = fbx_global(top, nullptr);
        const FbxGlobal second = fbx_global(middle, &first);
        return fbx_global(end, &second).node.offset;
    };
    const auto expect = [](const glm::dvec3& at, const glm::dvec3& right, const char* what) {
        EXPECT_LT(glm::distance(at, right), 1e-12) << what << ": " << at.x << " " << at.y << " " << at.z;
    };
    using enum FbxInherit;
    // The middle stands at x = 2. There (1, 1) is (1, 3) by its own scale, turned to (-3, 1), and all of that twice as
    // wide in x.
    expect(place(with_shear, with_shear), {-4, 1, 0}, "RSrs");
    // The scale of 2 goes along the middle's own x, so it is (2, 3) before it is turned.
    expect(place(along_axes, along_axes), {-1, 2, 0}, "RrSs");
    expect(place(along_axes, with_shear), {-1, 2, 0}, "RrSs, then RSrs");
    // The middle takes on nothing of the top's scale, but stands where it stands.
    expect(place(without_parent, with_shear), {-1, 1, 0}, "Rrs");
}

TEST(FbxProperties, AreKnownByTheirNamesInFiles) {
    EXPECT_EQ(fbx_property("Lcl Translation"), FbxProperty::translation);
    EXPECT_EQ(fbx_property("PostRotation"), FbxProperty::post_rotation);
    EXPECT_EQ(fbx_property("GeometricTranslation"), std::nullopt);
}

}  // namespace
}  // namespace mobbscope
