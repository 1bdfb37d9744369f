// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/legend.hpp"

#include "tests/eval/map_files/cloud_bytes.hpp"
#include "tests/support/expect_error.hpp"

namespace mapscore::eval {
namespace {

using testing::expect_error;
using testing::household;
using Classes = std::vector<ClassId>;
using Leftovers = std::vector<Leftover>;

struct LegendFile : testing::MapFiles {
  Legend read(const std::string& text) {
    return read_legend(file("legend.yaml", text), household());
  }
  void expect_refusal(const std::string& text, const std::string& part) {
    const auto path = file("legend.yaml", text);
    expect_error(part, [&] { (void)read_legend(path, household()); });
  }
};

TEST_F(LegendFile, AllSections) {
  const Legend legend = read(
      "# of another lab\ncolours: {\"FF0000\": cup, \"00ff10\": background}\n"
      "ids: {3: chair, -1: background}\nnames:\n  Stuhl: chair\n  \"a: b\": cup\n");
  EXPECT_EQ(legend.colours, (std::map<std::uint32_t, ClassId>{{0xff0000, 1}, {0xff10, 0}}));
  EXPECT_EQ(legend.ids, (std::map<std::uint32_t, ClassId>{{3, 2}, {0xffffffffu, 0}}));
  EXPECT_EQ(legend.names, (std::map<std::string, ClassId>{{"Stuhl", 2}, {"a: b", 1}}));
}

TEST_F(LegendFile, ManyValuesAreRefusedBeforeParsing) {
  expect_refusal("ids: [" + std::string(1 << 19, ',') + "]\n",
                 "legend.yaml: more than 524288 values; is it the right file?");
}

TEST_F(LegendFile, BadLegends) {
  expect_refusal("", "legend.yaml:1: the file is empty");
  expect_refusal("[cup]", "legend.yaml:1: is a list; write a section");
  expect_refusal("ids: {3: chair\nnames: }", "not YAML");
  expect_refusal("ids: {3: chair}\nlabels: {}\n",
                 "legend.yaml:2: labels: unknown key 'labels'; write one of colours, ids, names");
  expect_refusal("ids: {3: chair}\nids: {4: cup}\n", "legend.yaml:2: ids: key 'ids' stands twice");
  expect_refusal("ids: chair\n", "legend.yaml:1: ids: is chair; write a section, key: value");
  expect_refusal("ids:\n", "ids: has no value; write a section");
  expect_refusal("ids: {3: [chair]}\n",
                 "legend.yaml:1: ids.3: is a list; write a class of the truth");
  expect_refusal("ids: {[3]: chair}\n", "legend.yaml:1: ids: a key is not a word");
  expect_refusal("ids: {3: }\n", "ids.3: has no value; write a class of the truth");
  expect_refusal("ids:\n  3: chair\n  3.5: cup\n",
                 "legend.yaml:3: ids.3.5: is 3.5; write a whole number");
  expect_refusal("ids: {4294967296: cup}", "is 4294967296; write a whole number of 32 bits");
  expect_refusal("colours: {red: cup}\n", "is red; write six hexadecimal digits in quotes");
  expect_refusal("colours: {\"FF00GG\": cup}\n", "is FF00GG; write six hexadecimal digits");
  expect_refusal("colours: {\"0xFF00\": cup}\n", "is 0xFF00; write six hexadecimal digits");
  expect_refusal("ids:\n  3: chair\n  3: cup\n", "legend.yaml:3: ids.3: key '3' stands twice");
  expect_refusal("ids:\n  3: chair\n  03: cup\n", "legend.yaml:3: ids.03: '03' stands twice");
  expect_refusal("colours:\n  \"FF0000\": chair\n  \"ff0000\": cup\n",
                 "legend.yaml:3: colours.ff0000: 'ff0000' stands twice");
  expect_refusal(
      "ids:\n  3: stool\n",
      "legend.yaml:2: ids.3: the truth has no class 'stool'; its classes are background, cup, "
      "chair, sofa");
  expect_refusal("ids: {}\n", "legend.yaml:1: the legend names no class");
}

MapFile labelled(LabelKind kind, std::vector<std::uint32_t> labels) {
  MapFile map;
  map.label_kind = kind;
  for (std::size_t n = 0; n < labels.size(); ++n)
    map.voxels.push_back({static_cast<std::int32_t>(n), 0, 0});
  map.labels = std::move(labels);
  return map;
}

TEST(ApplyLegend, WithoutOneColoursAndIdsAreTheTables) {
  const Labelling colours =
      apply_legend(labelled(LabelKind::colour, {0xff0000, 0x123456, 0x808080, 0x123456, 0xabcdef}),
                   {}, household());
  EXPECT_EQ(colours.classes, (Classes{1, 0, 0, 0, 0}));
  EXPECT_EQ(colours.leftovers, (Leftovers{{"123456", 2}, {"ABCDEF", 1}}));
  const Labelling ids =
      apply_legend(labelled(LabelKind::id, {0, 3, 4, 0xffffffff}), {}, household());
  EXPECT_EQ(ids.classes, (Classes{0, 3, 0, 0}));
  EXPECT_EQ(ids.leftovers, (Leftovers{{"-1", 1}, {"4", 1}}));
}

TEST(ApplyLegend, AColourOfTwoClassesNeedsALegend) {
  const MapFile map = labelled(LabelKind::colour, {0x0000ff});
  expect_error("colour 0000FF of the map is that of class chair and of sofa",
               [&] { (void)apply_legend(map, {}, household()); });
  Legend legend;
  legend.colours[0xff] = 3;
  EXPECT_EQ(apply_legend(map, legend, household()).classes, Classes{3});
}

TEST(ApplyLegend, IdsAndColoursThatALegendDoesNotListKeepTheirOwnMeaning) {
  Legend legend;
  legend.ids = {{7, 2}, {8, kBackground}, {3, 1}};
  const Labelling ids =
      apply_legend(labelled(LabelKind::id, {7, 8, 1, 3, 9, 0}), legend, household());
  EXPECT_EQ(ids.classes, (Classes{2, 0, 1, 1, 0, 0}));
  EXPECT_EQ(ids.leftovers, (Leftovers{{"9", 1}}));
  EXPECT_EQ(ids.unlisted, (Leftovers{{"1", 1}}));
  legend.colours = {{0x0000ff, 3}, {0x123456, 1}};
  const Labelling colours = apply_legend(
      labelled(LabelKind::colour, {0x0000ff, 0x123456, 0xff0000}), legend, household());
  EXPECT_EQ(colours.classes, (Classes{3, 1, 1}));
  EXPECT_EQ(colours.unlisted, (Leftovers{{"FF0000", 1}}));
  EXPECT_TRUE(apply_legend(labelled(LabelKind::id, {1, 2}), {}, household()).unlisted.empty());
}

TEST(ApplyLegend, NamesKeepTheirOwnMeaningBesideTheLegends) {
  MapFile map = labelled(LabelKind::name, {0, 1, 2, 3, 0});
  map.names = {"Stuhl", "cup", "moon", "background"};
  Legend legend;
  legend.names["Stuhl"] = 2;
  const Labelling names = apply_legend(map, legend, household());
  EXPECT_EQ(names.classes, (Classes{2, 1, 0, 0, 2}));
  EXPECT_EQ(names.leftovers, (Leftovers{{"moon", 1}}));
}

TEST(ApplyLegend, FreeVoxelsLeaveNothingOver) {
  MapFile map = labelled(LabelKind::id, {1, 9, 9});
  map.occupied = {1, 0, 1};
  EXPECT_EQ(apply_legend(map, {}, household()).leftovers, (Leftovers{{"9", 1}}));
  map.occupied = {0, 0, 1};
  expect_error("no label of the map means a class",
               [&] { (void)apply_legend(map, {}, household()); });
}

/// `meaningless` elements of label 99 among 1000, the others of class 1.
MapFile mostly(LabelKind kind, std::size_t meaningless) {
  std::vector<std::uint32_t> labels(1000, kind == LabelKind::colour ? 0xff0000u : 1u);
  std::fill_n(labels.begin(), meaningless, 99u);
  return labelled(kind, std::move(labels));
}

TEST(ApplyLegend, LabelsThatMostlyMeanNothingAreRefused) {
  for (const LabelKind kind : {LabelKind::id, LabelKind::colour}) {
    EXPECT_EQ(apply_legend(mostly(kind, 950), {}, household()).leftovers.front().count, 950u);
    expect_error("the labels of 95.1 % of the map mean no class: ",
                 [&] { (void)apply_legend(mostly(kind, 951), {}, household()); });
  }
  Legend legend;  // says that they are no class, so they mean something
  legend.ids = {{99, kBackground}, {7, 1}};
  EXPECT_TRUE(apply_legend(mostly(LabelKind::id, 999), legend, household()).leftovers.empty());
}

TEST(ApplyLegend, ACamerasColoursAreNamedForWhatTheyAre) {
  std::vector<std::uint32_t> labels(2002, 0xff0000);  // and half of them, and one, all different
  for (std::uint32_t n = 0; n < 1002; ++n) labels[n] = 0x1000 + n;
  expect_error(
      "1002 different colours without a meaning, on 50.0 % of the map: these are a camera's",
      [&] { (void)apply_legend(labelled(LabelKind::colour, labels), {}, household()); });
  labels.push_back(0xff0000);
  labels.push_back(0xff0000);
  EXPECT_EQ(apply_legend(labelled(LabelKind::colour, labels), {}, household()).leftovers.size(),
            1002u);
}

TEST(ApplyLegend, GeometryAloneHasNoClassesAndThatIsNoError) {
  MapFile map;
  map.points = {{0, 0, 0}, {1, 1, 1}};
  const Labelling labelling = apply_legend(map, {}, household());
  EXPECT_EQ(labelling.classes, (Classes{0, 0}));
  EXPECT_TRUE(labelling.leftovers.empty());
}

TEST(ApplyLegend, LabelsWithoutAnyMeaningAreAnErrorThatListsThem) {
  const MapFile map = labelled(LabelKind::id, {10, 11, 12, 13, 14, 15, 15});
  expect_error(
      "no label of the map means a class: '15' (2 times), '10' (1 times), '11' (1 times), '12' (1 "
      "times), '13' (1 times) and 1 more; give their meaning under `ids` of a file for --legend, "
      "or score the geometry alone with --geometry",
      [&] { (void)apply_legend(map, {}, household()); });
  Legend legend;
  legend.colours[0xff] = 3;
  expect_error("the map's labels are ids, and the legend has none",
               [&] { (void)apply_legend(map, legend, household()); });
  expect_error("all are background", [&] {
    (void)apply_legend(labelled(LabelKind::id, {0, 0}), {}, household());
  });
}

}  // namespace
}  // namespace mapscore::eval
