#pragma once
#include <nlohmann/json.hpp>

#include "output.hpp"
#include "wordgaze/evaluation/transparency.hpp"

/// Transparency as JSON and as a table; docs/metrics.md defines the numbers.
namespace wordgaze::apps {

using Json = nlohmann::ordered_json;
using evaluation::Change;

inline Json to_json(const evaluation::Pointing& p) {
  return {{"target", p.target.value()},
          {"target_chance", p.target_chance.value()},
          {"target_count", p.target.count},
          {"named", p.named.value()},
          {"named_chance", p.named_chance.value()},
          {"named_count", p.named.count}};
}

inline Json to_json(const evaluation::Mass& mass) {
  Json json;
  const auto roles = names(evaluation::Role{});
  for (std::size_t r = 0; r < roles.size(); ++r) {
    json[std::string(roles[r])] = {{"share", mass.share[r].value()},
                                   {"even", mass.even[r].value()}};
  }
  json["nowhere"] = {{"share", mass.nowhere.value()}, {"even", 0.0}};
  return json;
}

inline Json to_json(const evaluation::Glow& glow) {
  return {{"brightest", glow.brightest.value()},
          {"over_half", glow.over_half.value()},
          {"count", glow.brightest.count}};
}

inline Json to_json(const evaluation::Faithfulness& faithfulness) {
  const auto effects = [&](Change::Test test) {
    Json json;
    for (const int k : evaluation::kDeletedCells) {
      const auto shift = [&](Change::Cells cells) {
        return faithfulness.of(test, cells, k).value();
      };
      json[std::to_string(k)] = {{"brightest", shift(Change::Cells::brightest)},
                                 {"others", shift(Change::Cells::others)},
                                 {"objects", shift(Change::Cells::objects)}};
    }
    return json;
  };
  return {{"deletion", effects(Change::Test::deletion)},
          {"insertion", effects(Change::Test::insertion)}};
}

inline Json to_json(const evaluation::MapReport& report) {
  return {{"pointing", to_json(report.pointing)},
          {"mass_in_view", to_json(report.mass_in_view)},
          {"mass_out_of_view", to_json(report.mass_out_of_view)},
          {"faithfulness", to_json(report.faithfulness)},
          {"faithfulness_in_view", to_json(report.faithfulness_in_view)}};
}

/// What the agent lacks is null.
inline Json to_json(const evaluation::Transparency& t) {
  Json json{{"decisions", t.decisions()}, {"gaze", nullptr}};
  if (t.has_gaze()) {
    json["gaze"] = to_json(t.gaze());
    json["gaze"]["filter_in_view"] = to_json(t.filter());
    json["gaze"]["spotlight_in_view"] = to_json(t.spotlight());
    json["gaze"]["glow_out_of_view"] = to_json(t.glow());
    json["gaze"]["spotlight_glow_out_of_view"] = to_json(t.spotlight_glow());
  }
  json["gradient"] = to_json(t.gradient());
  json["gradient_times_input"] = to_json(t.gradient_times_input());
  json["words"] = nullptr;
  json["mask"] = nullptr;
  if (t.has_gaze()) {
    json["words"] = {{"color_pointing", t.words().color.value()},
                     {"type_pointing", t.words().type.value()},
                     {"content_weight", t.weights().content.value()},
                     {"function_weight", t.weights().function.value()},
                     {"content_share", t.weights().content_share.value()},
                     {"content_share_even", t.weights().even_share.value()}};
  }
  if (t.has_mask()) {
    json["mask"] = {{"f1", t.mask().f1()},
                    {"precision", t.mask().precision()},
                    {"recall", t.mask().recall()},
                    {"alpha_bright", t.mask().bright.value()},
                    {"alpha_dark", t.mask().dark.value()},
                    {"changes", t.mask_delay().changes()},
                    {"changes_followed_at_once", t.mask_delay().at_once()},
                    {"changes_followed", t.mask_delay().steps().count},
                    {"delay", t.mask_delay().steps().value()}};
  }
  return json;
}

inline void print(std::string_view name, const evaluation::Mass& mass, bool in_view = true) {
  say("  {:<22} mass with {} target in view:", name, in_view ? "a" : "no");
  const auto roles = names(evaluation::Role{});
  for (std::size_t r = 0; r < roles.size(); ++r) {
    say(" {} {:.3f}", roles[r], mass.share[r].value());
  }
  say(" nowhere {:.3f}\n", mass.nowhere.value());
}

inline void print(std::string_view name, const evaluation::Glow& glow) {
  say("  {:<22} brightest object with no target in view: {:.3f}, above half in {:.4f}\n", name,
      glow.brightest.value(), glow.over_half.value());
}

inline void print(std::string_view name, const evaluation::MapReport& report) {
  const auto& p = report.pointing;
  say("  {:<22} points at a target {:.3f} (chance {:.3f}), at a named object {:.3f} ({:.3f})\n",
      name, p.target.value(), p.target_chance.value(), p.named.value(), p.named_chance.value());
  print("", report.mass_in_view);
  print("", report.mass_out_of_view, false);
  const auto& f = report.faithfulness_in_view;
  for (const auto test : {Change::Test::deletion, Change::Test::insertion}) {
    for (const int k : evaluation::kDeletedCells) {
      say("  {:<22} {} of {}: brightest {:.3f}, random others {:.3f}, other objects {:.3f}\n", "",
          test == Change::Test::deletion ? "deletion" : "insertion", k,
          f.of(test, Change::Cells::brightest, k).value(),
          f.of(test, Change::Cells::others, k).value(),
          f.of(test, Change::Cells::objects, k).value());
    }
  }
}

inline void print(const evaluation::Transparency& t) {
  if (t.has_gaze()) {
    print("gaze M", t.gaze());
    print("", t.glow());
    print("filter s(M)", t.filter());
    print("spotlight s(M) - f", t.spotlight());
    print("", t.spotlight_glow());
  }
  print("gradient", t.gradient());
  print("gradient times input", t.gradient_times_input());
  if (t.has_gaze()) {
    say("  {:<22} points at its color {:.3f}, its type {:.3f}\n", "map of a word",
        t.words().color.value(), t.words().type.value());
    say("  {:<22} content {:.3f}, function {:.3f}; all content words {:.3f} (even {:.3f})\n",
        "weight of a word", t.weights().content.value(), t.weights().function.value(),
        t.weights().content_share.value(), t.weights().even_share.value());
  }
  if (t.has_mask()) {
    say("  {:<22} F1 {:.4f}; alpha {:.3f} on bright words, {:.3f} on dark ones\n", "mask",
        t.mask().f1(), t.mask().bright.value(), t.mask().dark.value());
    say("  {:<22} follows {} of {} changes of c_t at once, {} in all, after {:.2f} steps\n", "",
        t.mask_delay().at_once(), t.mask_delay().changes(), t.mask_delay().steps().count,
        t.mask_delay().steps().value());
  }
}

}  // namespace wordgaze::apps
