#include "wordgaze/model/agent.hpp"

template struct wordgaze::model::Agent<float>;
