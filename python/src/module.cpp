#include "bindings.hpp"

NB_MODULE(_core, module) {
  module.doc() = "The simulator and the agents of Wordgaze, as the package `wordgaze` uses them.";
  wordgaze::python::bind_names(module);
  wordgaze::python::bind_level(module);
  wordgaze::python::bind_environment(module);
  wordgaze::python::bind_vector_env(module);
  wordgaze::python::bind_tiles(module);
  wordgaze::python::bind_policy(module);
}
