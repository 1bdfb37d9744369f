// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/class_assignment.hpp"

#include "core/error.hpp"
#include "files/text.hpp"
#include "sim/world/mujoco_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace mapscore::sim {
namespace {

/// Of a body that becomes an object.
std::string instance_name(const mjModel& model, int body) {
  const std::string name = element_name(model, mjOBJ_BODY, body);
  if (const auto unfit = unfit_as_name(name))
    throw Error(fmt::format("scene: the name of body {}: {} in the MJCF", body, *unfit));
  return name;
}

std::string display_name(const mjModel& model, int body) {
  const std::string name = element_name(model, mjOBJ_BODY, body);
  return name.empty() ? fmt::format("(body {})", body) : name;
}

/// Index of the rule that claims a body, -1 for none.
int matching_rule(const std::vector<ClassRule>& rules, const std::string& body,
                  const std::filesystem::path& file) {
  int match = -1;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (!rules[i].matches(body)) continue;
    if (match >= 0)
      throw Error(fmt::format(
          "{}: classes.bodies: body `{}` belongs to `{}` and to `{}`; narrow a pattern",
          file.string(), body, rules[match].semantic_class.name, rules[i].semantic_class.name));
    match = static_cast<int>(i);
  }
  return match;
}

/// Refuses patterns of a class file that match none of the names: most are misspelt.
void refuse_unknown(const std::vector<ClassRule>& rules, const std::vector<std::string>& names,
                    const std::filesystem::path& file) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (rules[i].line == 0) continue;
    for (const std::string& pattern : rules[i].bodies) {
      const auto known = [&](const std::string& name) { return matches(pattern, name); };
      if (std::ranges::any_of(names, known)) continue;
      throw Error(
          fmt::format("{}:{}: classes[{}].bodies: pattern `{}` matches no body of the scene; mend "
                      "or drop it",
                      file.string(), rules[i].line, i, pattern));
    }
  }
}

void set_owners(const mjModel& model, Ownership& ownership) {
  ownership.owner_of_body.assign(model.nbody, -1);
  for (int body = 0; body < model.nbody; ++body) {  // parents come first
    const int parent = model.body_parentid[body];
    const int inherited = parent > 0 ? ownership.owner_of_body[parent] : -1;
    ownership.owner_of_body[body] = ownership.rule_of_body[body] >= 0 ? body : inherited;
  }
}

ClassId add_class(ClassTable& table, SemanticClass semantic_class) {
  semantic_class.id = static_cast<ClassId>(table.classes.size());
  table.classes.push_back(std::move(semantic_class));
  return table.classes.back().id;
}

/// Class ids of the rules: all of a class file's, else those that are used, in order of first use.
std::vector<ClassId> add_classes(ClassTable& table, const Ownership& ownership,
                                 const std::set<int>& owners, bool from_file) {
  std::vector<ClassId> ids(ownership.rules.size(), kBackground);
  if (from_file) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      ids[i] = add_class(table, ownership.rules[i].semantic_class);
    return ids;
  }
  for (const int owner : owners) {
    const int rule = ownership.rule_of_body[owner];
    if (ids[rule] != kBackground) continue;
    SemanticClass semantic_class = ownership.rules[rule].semantic_class;
    semantic_class.colour = palette_colour(static_cast<ClassId>(table.classes.size()));
    ids[rule] = add_class(table, std::move(semantic_class));
  }
  return ids;
}

}  // namespace

Ownership assign_bodies(const mjModel& model,
                        const std::optional<std::filesystem::path>& class_file,
                        const std::vector<bool>& robot_body) {
  Ownership ownership;
  if (class_file) ownership.rules = read_class_file(*class_file);
  std::map<std::string, int> rule_of_class;
  const auto rule_by_name = [&](const std::string& body) {  // one for each class
    const std::string name = class_name_of_body(body);
    const auto [entry, fresh] =
        rule_of_class.try_emplace(name, static_cast<int>(ownership.rules.size()));
    if (fresh) ownership.rules.emplace_back().semantic_class = {.name = name, .detect = true};
    return entry->second;
  };
  ownership.rule_of_body.assign(model.nbody, -1);
  std::vector<std::string> names;
  for (int body = 0; body < model.nbody; ++body) {
    const std::string name = element_name(model, mjOBJ_BODY, body);
    if (name.empty() || robot_body[body]) continue;
    names.push_back(name);
    if (class_file)
      ownership.rule_of_body[body] = matching_rule(ownership.rules, name, *class_file);
    else if (body > 0)
      ownership.rule_of_body[body] = rule_by_name(name);
  }
  if (class_file) refuse_unknown(ownership.rules, names, *class_file);
  set_owners(model, ownership);
  return ownership;
}

Assignment assign_geoms(const mjModel& model, const Ownership& ownership,
                        const std::vector<int>& drawn_geoms, bool from_file) {
  std::set<int> owners, unmatched;
  for (const int geom : drawn_geoms) {
    const int body = model.geom_bodyid[geom];
    const int owner = ownership.owner_of_body[body];
    (owner >= 0 ? owners : unmatched).insert(owner >= 0 ? owner : body);
  }
  if (owners.size() > std::numeric_limits<InstanceId>::max())
    throw Error(fmt::format("scene: {} objects; label images hold at most 65535", owners.size()));
  Assignment assignment;
  ClassTable& table = assignment.table;
  const std::vector<ClassId> class_of_rule = add_classes(table, ownership, owners, from_file);
  std::vector<InstanceId> instance_of_body(model.nbody, 0);
  for (const int owner : owners) {
    const auto id = static_cast<InstanceId>(table.instances.size());
    instance_of_body[owner] = id;
    table.instances.push_back(
        {id, instance_name(model, owner), class_of_rule[ownership.rule_of_body[owner]]});
  }
  assignment.geom_instances.assign(model.ngeom, 0);
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int owner = ownership.owner_of_body[model.geom_bodyid[geom]];
    if (owner >= 0) assignment.geom_instances[geom] = instance_of_body[owner];
  }
  for (const int body : unmatched) assignment.unmatched_bodies.push_back(display_name(model, body));
  return assignment;
}

}  // namespace mapscore::sim
