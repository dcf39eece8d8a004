#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <string_view>

#include "bindings.hpp"
#include "wordgaze/babyai/level.hpp"
#include "wordgaze/babyai/sentence.hpp"
#include "wordgaze/babyai/vocabulary.hpp"
#include "wordgaze/grid/action.hpp"
#include "wordgaze/grid/cell.hpp"

namespace nb = nanobind;

namespace wordgaze::python {
namespace {

template <class Names>
nb::tuple tuple_of(const Names& names) {
  nb::list list;
  for (const std::string_view name : names) list.append(name);
  return nb::tuple(list);
}

nb::list words_of(std::string_view mission) {
  nb::list ids;
  for (const babyai::WordId id : babyai::sentence_of(mission)) ids.append(int{id});
  return ids;
}

}  // namespace

void bind_names(nb::module_& module) {
  module.attr("ACTIONS") = tuple_of(grid::kActionNames);
  module.attr("OBJECT_TYPES") = tuple_of(grid::kTypeNames);
  module.attr("COLORS") = tuple_of(grid::kColorNames);
  module.attr("VOCABULARY") = tuple_of(babyai::kWords);
  module.attr("MAX_MISSION_WORDS") = babyai::kMaxMissionWords;
  module.def("level_ids", &babyai::level_ids, "The ids of all levels that are known.");
  module.def("tokens", &words_of, nb::arg("mission"),
             "The ids of a mission's words in the vocabulary; a comma is a word. Raises ValueError "
             "for a word that is not in it.");
}

}  // namespace wordgaze::python
