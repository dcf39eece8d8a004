#pragma once
#include <nanobind/nanobind.h>

/// The parts of the module, one concept each.
namespace wordgaze::python {

void bind_names(nanobind::module_& module);
void bind_level(nanobind::module_& module);
void bind_environment(nanobind::module_& module);
void bind_vector_env(nanobind::module_& module);
void bind_tiles(nanobind::module_& module);
void bind_policy(nanobind::module_& module);

}  // namespace wordgaze::python
