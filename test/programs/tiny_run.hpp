#pragma once
#include <array>
#include <string>

#include "programs/shell.hpp"

namespace wordgaze {

/// tiny.toml: a network and a run so small that training takes a moment.
inline void write_tiny_config(const Shell& run) {
  run.write("tiny.toml",
            "frames = 128\nthreads = 1\nprobe_every = 0\n"
            "[model]\nchannels = 4\nword_size = 4\nkey_size = 4\nmemory_size = 8\n"
            "text_size = 6\nhead_size = 8\ntask_size = 8\n"
            "[ppo]\nlanes = 8\nsteps = 8\nchunk = 8\nepochs = 1\nminibatches = 2\n");
}

/// Commands that make a good checkpoint, bad.safetensors, a bad one.
inline const std::array<std::string, 4> kDamages{
    "head -c 1000 bad.safetensors >cut; mv cut bad.safetensors",
    "truncate --size=0 bad.safetensors",
    // A byte in the middle of the numbers.
    "printf '\\xff' | dd of=bad.safetensors bs=1 seek=20000 conv=notrunc status=none",
    "echo 'Two roads diverged in a yellow wood' >bad.safetensors",
};

}  // namespace wordgaze
