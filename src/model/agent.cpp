#include "wordgaze/model/agent_impl.hpp"

template struct wordgaze::model::Agent<float>;
