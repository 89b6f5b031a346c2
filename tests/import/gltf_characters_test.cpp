// Who is in a glTF file: skins that are one body, people who are several clips, and any joint as root.
#include "gltf_bytes.h"

#include <import/skeleton/motion_clips.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Nodes by name, with what moves them: times are 0 and 2 s.
class Stage {
  public:
    /// `place`: "x,y,z" below the parent.
    Stage& node(const std::string& name, const std::string& parent = "", const std::string& place = "0,0,0") {
        const int index = static_cast<int>(nodes_.size());
        nodes_.push_back({name, place, {}});
        index_.emplace(name, index);
        if (!parent.empty()) nodes_[static_cast<std::size_t>(index_.at(parent))].children.push_back(index);
        return *this;
    }
    /// Hips a metre up, a head, and two hands 0.6 m aside.
    Stage& body(const std::string& of, const std::string& parent = "", const std::string& place = "0,1,0") {
        node(of + "Hips", parent, place).node(of + "Head", of + "Hips", "0,0.7,0");
        return node(of + "Left", of + "Hips", "0.6,0.4,0").node(of + "Right", of + "Hips", "-0.6,0.4,0");
    }
    Stage& skin(const std::vector<std::string>& joints, const std::string& skeleton = "") {
        std::string list;
        for (const std::string& joint : joints) list += (list.empty() ? "" : ",") + std::to_string(index_.at(joint));
        skins_ += (skins_.empty() ? "" : ",") + ("{\"joints\":[" + list + "]") +
                  (skeleton.empty() ? "" : ",\"skeleton\":" + std::to_string(index_.at(skeleton))) + "}";
        return *this;
    }
    Stage& skin_of_body(const std::string& of) { return skin({of + "Hips", of + "Head", of + "Left", of + "Right"}); }
    /// The node goes that far from `from` along x.
    Stage& walks(const std::string& name, float metres, const std::vector<float>& from = {0, 1, 0}) {
        const int places = bytes_.add_floats("VEC3", {from[0], from[1], from[2], from[0] + metres, from[1], from[2]});
        bytes_.channel(std::to_string(index_.at(name)), "translation", times_, places);
        return *this;
    }
    Stage& turns(const std::string& name) {
        const int turns = bytes_.add_floats("VEC4", {0, 0, 0, 1, 0, 0.6F, 0, 0.8F});
        bytes_.channel(std::to_string(index_.at(name)), "rotation", times_, turns);
        return *this;
    }
    Stage& animation(const std::string& name) {
        bytes_.animation(name);
        return *this;
    }
    std::string glb(const std::string& rest = "") const {
        std::string nodes;
        for (const StagedNode& node : nodes_) {
            std::string children;
            for (const int child : node.children) children += (children.empty() ? "" : ",") + std::to_string(child);
            nodes += (nodes.empty() ? "" : ",") +
                     ("{\"name\":\"" + node.name + "\",\"translation\":[" + node.place + "]") +
                     (children.empty() ? "" : ",\"children\":[" + children + "]") + "}";
        }
        return bytes_.glb("[" + nodes + "]", (skins_.empty() ? "" : ",\"skins\":[" + skins_ + "]") + rest);
    }

  private:
    struct StagedNode {
        std::string name;
        std::string place;
        std::vector<int> children;
    };
    GltfBytes bytes_;
    int times_ = bytes_.add_floats("SCALAR", {0, 2});
    std::vector<StagedNode> nodes_;
    std::map<std::string, int> index_;
    std::string skins_;
};

std::vector<ImportedClip> staged_clips(const Stage& stage, const std::string& root = "",
                                       const std::string& animation = "") {
    ImportOptions options;
    if (!root.empty()) options.root = root;
    if (!animation.empty()) options.animation = animation;
    return motion_clips(parse_gltf(stage.glb(), "stage.glb"), "stage.glb", options);
}

std::vector<std::string> staged_names(const std::vector<ImportedClip>& clips) {
    std::vector<std::string> out;
    for (const ImportedClip& clip : clips) out.push_back(clip.name);
    return out;
}

/// That there is one character with this root and as many joints, which goes as far along x.
void expect_one(const Stage& stage, const std::string& root, int joints, double metres, double radius) {
    const std::vector<ImportedClip> clips = staged_clips(stage);
    ASSERT_EQ(clips.size(), 1u) << clips[1].name;
    EXPECT_EQ(clips[0].name, "stage");
    EXPECT_EQ(clips[0].root, "") << "there is none to choose";
    EXPECT_EQ(clips[0].facts.root, root);
    EXPECT_EQ(clips[0].facts.joints, joints);
    const auto samples = clips[0].clip->samples();
    EXPECT_NEAR(samples.back().x - samples.front().x, metres, 1e-6);
    EXPECT_NEAR(samples.back().r, radius, 1e-6);
}

using Names = std::vector<std::string>;

TEST(GltfCharacters, AVisorIsPartOfTheBodyThatItsJointIsBelow) {
    // In the order of the file the visor comes first.
    Stage visor;
    visor.body("").node("Visor", "Head", "0,0.1,0.2").skin({"Visor"}).skin_of_body("").walks("Hips", 4);
    expect_one(visor.animation("walk"), "Hips", 5, 4, 0.6);
    // It is one of the body's own joints.
    Stage own;
    own.body("").skin({"Head"}).skin_of_body("").walks("Hips", 4).animation("walk");
    expect_one(own, "Hips", 4, 4, 0.6);
    // What it hangs on is no joint.
    Stage mount;
    mount.body("").node("Mount", "Head").node("Visor", "Mount", "0,0,0.9").skin({"Visor"}).skin_of_body("");
    expect_one(mount.walks("Hips", 4).animation("walk"), "Hips", 5, 4, 0.9);
    // Body, hair of three joints and visor, none of them named by the body.
    Stage hair;
    hair.body("").node("Hair1", "Head").node("Hair2", "Hair1").node("Hair3", "Hair2").node("Visor", "Head");
    hair.skin({"Hair2", "Hair1", "Hair3"}).skin({"Visor"}).skin_of_body("").walks("Hips", 4).animation("walk");
    expect_one(hair, "Hips", 8, 4, 0.6);
    // The armature moves, not the hips.
    Stage armature;
    armature.node("Armature").body("", "Armature").node("Visor", "Head").skin({"Visor"}).skin_of_body("");
    expect_one(armature.walks("Armature", 4).animation("walk"), "Hips", 5, 4, 0.6);
}

TEST(GltfCharacters, SkinsOfOneBodyShareItsRoot) {
    // A weapon with a skin and a skeleton of its own in the hand: it widens the disk.
    Stage weapon;
    weapon.body("").node("Sword", "Right").node("Grip", "Sword").node("Tip", "Grip", "-0.9,0,0");
    weapon.skin({"Grip", "Tip"}).skin_of_body("").walks("Hips", 4).animation("walk");
    expect_one(weapon, "Hips", 6, 4, 1.5);
    // Upper and lower part share the hips.
    Stage halves;
    halves.body("").skin({"Left", "Right", "Hips"}).skin({"Hips", "Head"}).walks("Hips", 4).animation("walk");
    expect_one(halves, "Hips", 4, 4, 0.6);
    // Three meshes with the same joints, in another order each.
    Stage meshes;
    meshes.body("").skin_of_body("").skin({"Left", "Head", "Hips", "Right"}).skin({"Right", "Hips", "Left", "Head"});
    expect_one(meshes.walks("Hips", 4).animation("walk"), "Hips", 4, 4, 0.6);
    // Hips that no skin names, as nothing hangs on them alone: they are what moves.
    Stage parts;
    parts.body("")
        .skin({"Left", "Right"})
        .skin({"Head"})
        .walks("Hips", 4)
        .turns("Hips")
        .turns("Left")
        .animation("walk");
    expect_one(parts, "Hips", 4, 4, 0.6);
    // A visor beside the hips, on the armature that carries both.
    Stage beside;
    beside.node("Armature").node("Visor", "Armature", "0,1.7,0").body("", "Armature").skin({"Visor"}).skin_of_body("");
    expect_one(beside.walks("Armature", 4).walks("Hips", 1).animation("walk"), "Hips", 4, 5, 0.6);
    // The same below a node between them, where the skins say what their skeleton is.
    Stage named;
    named.node("Armature").node("Mount", "Armature").node("Visor", "Mount").body("", "Armature");
    named.skin({"Visor"}, "Armature").skin({"Hips", "Head", "Left", "Right"}, "Armature");
    expect_one(named.walks("Armature", 4).walks("Hips", 1).animation("walk"), "Hips", 4, 5, 0.6);
}

TEST(GltfCharacters, ASkinThatListsAPartOfTheJointsBeginsWhereTheyHang) {
    Stage pruned;
    pruned.body("").skin({"Left", "Head", "Right"}).walks("Hips", 4).animation("walk");
    expect_one(pruned, "Hips", 4, 4, 0.6);
    // What only holds them is not the body: controls beside the hips, named before them.
    Stage controls;
    controls.node("Armature").node("Control", "Armature").body("", "Armature");
    controls.skin({"Control", "Hips", "Head", "Left", "Right"}).walks("Hips", 4).animation("walk");
    expect_one(controls, "Hips", 4, 4, 0.6);
    // Nor is a scene that stands still.
    Stage scene;
    scene.node("Scene").body("", "Scene").node("Prop", "Scene");
    expect_one(scene.skin({"Hips", "Prop", "Head", "Left"}).walks("Hips", 4).animation("walk"), "Hips", 3, 4, 0.6);
    // A wrapper that is a joint and stands still is ignored, as in any skeleton.
    Stage wrapped;
    wrapped.node("Root").body("", "Root").skin({"Root", "Hips", "Head", "Left", "Right"}).walks("Hips", 4);
    expect_one(wrapped.animation("walk"), "Hips", 4, 4, 0.6);
    // Joints that no joint leads to, at the top of the file.
    Stage loose;
    loose.body("").node("Cape").skin({"Hips", "Head", "Left", "Right", "Cape"}).walks("Hips", 4).animation("walk");
    expect_one(loose, "Hips", 4, 4, 0.6);
}

/// Two people who walk 4 and 3 m, the second 3 m aside.
void expect_pair(const std::vector<ImportedClip>& clips) {
    ASSERT_EQ(staged_names(clips), (Names{"both · AHips", "both · BHips"}));
    const double from[] = {0, -3};
    const double metres[] = {4, 3};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto samples = clips[i].clip->samples();
        EXPECT_EQ(clips[i].root, i == 0 ? "AHips" : "BHips");
        EXPECT_EQ(clips[i].animation, "") << "the file has one";
        EXPECT_EQ(clips[i].facts.joints, 4);
        EXPECT_NEAR(samples.front().y, from[i], 1e-6);
        EXPECT_NEAR(samples.back().x, metres[i], 1e-6);
        EXPECT_NEAR(samples.back().r, 0.6, 1e-6);
    }
}

TEST(GltfCharacters, PeopleWithSkeletonsOfTheirOwnAreSeveralClips) {
    const auto both = [](Stage stage) {
        stage.skin_of_body("A").skin_of_body("B").walks("AHips", 4).walks("BHips", 3, {0, 1, 3});
        return staged_clips(stage.animation("both"));
    };
    expect_pair(both(Stage().body("A").body("B", "", "0,1,3")));
    // Below one scene, or armature, or collection.
    expect_pair(both(Stage().node("Scene").body("A", "Scene").body("B", "Scene", "0,1,3")));
    // Below an armature each, in one collection.
    Stage armatures;
    armatures.node("All").node("Armature", "All").body("A", "Armature").node("Armature2", "All");
    expect_pair(both(armatures.body("B", "Armature2", "0,1,3")));
    // Each in two skins, in turns.
    Stage turns;
    turns.body("A").body("B", "", "0,1,3").skin({"AHead"}).skin({"BLeft", "BHips"});
    expect_pair(both(turns));
    // What carries both may move, as a train does, and be named as the skeleton of each.
    Stage train;
    train.node("Train").body("A", "Train").body("B", "Train", "0,1,3").turns("Train").animation("ride");
    train.skin({"AHips"}, "Train").skin({"BHips"}, "Train");
    train.skin_of_body("A").skin_of_body("B").walks("AHips", 4).walks("BHips", 3, {0, 1, 3}).animation("both");
    EXPECT_EQ(staged_names(staged_clips(train)),
              (Names{"ride · AHips", "ride · BHips", "both · AHips", "both · BHips"}));
}

TEST(GltfCharacters, OnlyThoseThatAnAnimationMovesAreClipsOfIt) {
    Stage stage;
    stage.node("Camera").body("A").body("B", "", "0,1,3").skin_of_body("A").skin_of_body("B");
    stage.walks("AHips", 4).animation("walk").walks("BHips", 3, {0, 1, 3}).animation("run");
    stage.turns("BLeft").turns("AHead").animation("wave").walks("Camera", 9).animation("fly");
    const std::vector<ImportedClip> clips = staged_clips(stage);
    EXPECT_EQ(staged_names(clips), (Names{"walk · AHips", "run · BHips", "wave · AHips", "wave · BHips"}));
    EXPECT_EQ(clips[1].animation, "run");
    EXPECT_EQ(clips[1].root, "BHips");
    const auto tells = [](const ImportWarning& warning) {
        return warning.text ==
               "animation 'fly' is left out: it moves none of the file's 2 characters; give root to follow another "
               "joint";
    };
    for (const ImportedClip& clip : clips) {
        EXPECT_EQ(std::ranges::count_if(clip.facts.warnings, tells), 1) << clip.name;
    }
    // Of all animations those that move it; of one that is named, this one, though it stands.
    EXPECT_EQ(staged_names(staged_clips(stage, "BHips")), (Names{"run · BHips", "wave · BHips"}));
    EXPECT_EQ(staged_names(staged_clips(stage, "BHips", "walk")), (Names{"walk · BHips"}));
    EXPECT_EQ(staged_names(staged_clips(stage, "", "walk")), (Names{"walk · AHips"}));
    EXPECT_NE(input_error([&] {
                  staged_clips(stage, "", "fly");
              }).find("animation 'fly': moves none of the file's 2 characters"),
              std::string::npos);
    EXPECT_NEAR(staged_clips(stage, "Camera", "fly").at(0).clip->samples().back().x, 9, 1e-6);
}

TEST(GltfCharacters, JointsOfOneNameAreNumbered) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 2});
    bytes.channel("1", "translation", times, bytes.add_floats("VEC3", {0, 1, 0, 4, 1, 0}));
    bytes.channel("3", "translation", times, bytes.add_floats("VEC3", {0, 1, 3, 3, 1, 3})).animation("both");
    // A mesh has the name of a joint, too; joints come first.
    const std::string nodes =
        R"([{"name":"Hips"},{"name":"Hips","children":[2]},{"name":"Head","translation":[0.25,0.7,0]},)"
        R"({"name":"Hips","children":[4]},{"name":"Head","translation":[0.5,0.7,0]}])";
    const MotionFile file = parse_gltf(bytes.glb(nodes, R"(,"skins":[{"joints":[1,2]},{"joints":[4,3]}])"), "two.glb");
    const std::vector<ImportedClip> clips = motion_clips(file, "two.glb", {});
    EXPECT_EQ(staged_names(clips), (Names{"both · Hips", "both · Hips #2"}));
    EXPECT_EQ(clips[0].facts.rig, clips[1].facts.rig) << "they have one skeleton";
    const auto about = [&](const std::string& root) {
        ImportOptions options;
        options.root = root;
        return motion_clips(file, "two.glb", options).at(0);
    };
    EXPECT_NEAR(about("Hips").clip->samples().back().x, 4, 1e-6);
    EXPECT_NEAR(about("Hips #2").clip->samples().back().x, 3, 1e-6);
    EXPECT_NEAR(about("Hips #2").clip->samples().back().r, 0.5, 1e-6);
    EXPECT_NEAR(about("Head #2").clip->samples().back().x, 3.5, 1e-6);
    EXPECT_NEAR(about("Hips #3").clip->samples().back().x, 0, 1e-6) << "the mesh";
    EXPECT_EQ(input_error([&] { about("Hips #4"); }),
              "two.glb: there is no joint 'Hips #4' for root; the nearest is 'Hips #2'");
}

TEST(GltfCharacters, AnyNodeCanBeTheRoot) {
    Stage stage;
    stage.node("World").node("Armature", "World", "0,0,1").body("", "Armature").node("Twist", "Left", "0.2,0,0");
    stage.node("Finger", "Twist", "0.3,0,0").node("Mesh", "Head", "0,0,-5").node("Crate", "World", "2,0,0");
    stage.node("Lid", "Crate", "0,0,0.75").skin({"Hips", "Head", "Left", "Right", "Finger"});
    stage.walks("Hips", 4).walks("Crate", 1, {2, 0, 0}).animation("walk");
    struct Expected {
        const char* root;
        double x, y, r;  ///< at the end
        int joints;
    };
    for (const Expected& expected :
         {Expected{"Hips", 4, -1, 1.1, 5},      // of a skin: its joints below
          Expected{"Left", 4.6, -1, 0.5, 2},    //
          Expected{"Finger", 5.1, -1, 0, 1},    // at the tip
          Expected{"Twist", 4.8, -1, 0.3, 2},   // between two joints
          Expected{"Armature", 0, -1, 5.1, 6},  // above the skeleton: the joints of its skin, not its mesh
          Expected{"Crate", 3, 0, 0.75, 2},     // beside it
          Expected{"Lid", 3, -0.75, 0, 1},      //
          Expected{"Mesh", 4, 4, 0, 1}}) {      // a node that moves with a joint
        const ImportedClip clip = staged_clips(stage, expected.root).at(0);
        const mobb::Disk end = clip.clip->samples().back();
        EXPECT_EQ(clip.facts.root, expected.root);
        EXPECT_EQ(clip.facts.joints, expected.joints) << expected.root;
        EXPECT_NEAR(end.x, expected.x, 1e-6) << expected.root;
        EXPECT_NEAR(end.y, expected.y, 1e-6) << expected.root;
        EXPECT_NEAR(end.r, expected.r, 1e-6) << expected.root;
    }
    EXPECT_NE(input_error([&] { staged_clips(stage, "hips"); }).find("the nearest is 'Hips'"), std::string::npos);
    // Without a skin too: what is animated begins at the hips.
    Stage bare;
    bare.node("World").body("", "World").node("Crate", "World", "2,0,0").walks("Hips", 4).animation("walk");
    EXPECT_EQ(staged_clips(bare).at(0).facts.root, "Hips");
    EXPECT_EQ(staged_clips(bare, "World").at(0).facts.joints, 6);
    EXPECT_NEAR(staged_clips(bare, "Crate").at(0).clip->samples().front().x, 2, 1e-6);
}

TEST(GltfCharacters, ThereIsAnOfferOfAllWhoCanBeTheRoot) {
    Stage stage;
    stage.node("Camera").body("A").body("B", "", "0,1,3").skin_of_body("A").skin_of_body("B");
    stage.turns("Camera").animation("fly").walks("AHips", 4).walks("BHips", 3, {0, 1, 3}).animation("both");
    const MotionFile file = parse_gltf(stage.glb(), "stage.glb");
    const ImportOffer offer = motion_offer(file, "stage.glb", {});
    const OptionOffer* roots = offer.find("root");
    ASSERT_TRUE(roots);
    EXPECT_TRUE(roots->required);
    EXPECT_EQ(roots->choices.size(), 9u);
    EXPECT_EQ(roots->choices.front().value, "AHips");
    for (const OfferedChoice& choice : roots->choices) {
        ImportOptions options;
        options.root = choice.value;
        EXPECT_GE(motion_clips(file, "stage.glb", options).size(), 1u) << choice.value;
        EXPECT_NO_THROW(motion_offer(file, "stage.glb", options)) << choice.value;
    }
}

TEST(GltfCharacters, VrmSaysWhereTheBodyOfAnAnimationBegins) {
    // Expressions are nodes beside the body, whose places are weights.
    Stage stage;
    stage.node("happy").node("lookAt").node("Root").body("", "Root").walks("happy", 1).walks("Hips", 4);
    stage.animation("wave");
    const auto clip_with = [&](const std::string& rest) {
        return motion_clips(parse_gltf(stage.glb(rest), "wave.vrma"), "wave.vrma", {}).at(0);
    };
    EXPECT_EQ(clip_with("").facts.root, "happy") << "nothing says otherwise";
    const auto with_hips = [](const std::string& node) {
        return R"(,"extensions":{"VRMC_vrm_animation":{"humanoid":{"humanBones":{"hips":{"node":)" + node + "}}}}}";
    };
    const ImportedClip clip = clip_with(with_hips("3"));
    EXPECT_EQ(clip.facts.root, "Hips");
    EXPECT_EQ(clip.facts.joints, 4);
    EXPECT_NEAR(clip.clip->samples().back().x, 4, 1e-6);
    for (const char* node : {"99", "-1", "\"3\"", "null", "{}"}) {
        EXPECT_NE(input_error([&] { clip_with(with_hips(node)); }).find("its hips refer to"), std::string::npos)
            << node;
    }
    for (const char* other : {R"(,"extensions":{"VRMC_vrm_animation":{"humanoid":7}})", R"(,"extensions":[])",
                              R"(,"extensions":{"VRMC_vrm_animation":{"humanoid":{"humanBones":{}}}})"}) {
        EXPECT_EQ(clip_with(other).facts.root, "happy");
    }
}

TEST(GltfCharacters, AFileOfSkinsAloneIsBounded) {
    // A chain on whose end thousands of joints hang, each a skin of its own.
    constexpr int kChain = 20'000;
    constexpr int kSkins = 20'000;
    std::string nodes = "[";
    for (int i = 0; i < kChain; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
    nodes += "{\"children\":[";
    for (int i = 0; i < kSkins; ++i) nodes += (i > 0 ? "," : "") + std::to_string(kChain + 1 + i);
    nodes += "]}";
    std::string skins;
    std::string joints;
    for (int i = 0; i < kSkins; ++i) {
        const std::string joint = std::to_string(kChain + 1 + i);
        nodes += ",{}";
        skins += (i > 0 ? ",{\"joints\":[" : "{\"joints\":[") + joint + "]}";
        joints += (i > 0 ? "," : "") + joint;
    }
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 2});
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 1, 0, 4, 1, 0})).animation("walk");
    const std::string rigid = bytes.glb(nodes + "]", ",\"skins\":[" + skins + "]");
    const MotionFile one = parse_gltf(rigid, "many.glb");
    EXPECT_EQ(one.characters.size(), 1u) << "all hang on what moves";
    ImportOptions often;
    often.fps = 5000;
    EXPECT_EQ(input_error([&] { motion_clips(one, "many.glb", often); }),
              "many.glb: needs 40001 joints and layers of curves for each of 10001 frames, which is too much; check "
              "the file, "
              "or lower fps");
    EXPECT_EQ(parse_gltf(bytes.glb(nodes + "]", ",\"skins\":[{\"joints\":[" + joints + "]}]"), "many.glb")
                  .joints.front()
                  .name,
              "node20000");
    GltfBytes still;
    still.channel(std::to_string(kChain + 1), "rotation", still.add_floats("SCALAR", {0}),
                  still.add_floats("VEC4", {0, 0, 0, 1}));
    const std::string many = still.animation("wave").glb(nodes + "]", ",\"skins\":[" + skins + "]");
    EXPECT_EQ(input_error([&] { parse_gltf(many, "many.glb"); }),
              "many.glb: holds 20000 characters, but at most 1000 are read; export fewer at a time");
}

}  // namespace
}  // namespace mobbscope
