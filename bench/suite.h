// SPDX-License-Identifier: Apache-2.0
// Suites of stiction-bench: what each is, in a table; each measures, prints, and returns an exit code. Studies
// in Python stand beside them: bench/studies.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "search/generators/generators.h"

namespace stiction {

struct Suite {
  std::string_view name, help;
  std::string_view problems;  // what --problems counts; empty: it does not
  int most_contacts;          // that --contacts may ask for
  std::string_view tables;    // of stiction-peers, which measures them; empty: stiction-bench does
};

inline constexpr int kMostOfAnySuite = 2000;

inline constexpr std::array kSuites = {
    Suite{"search", "problems a second of a search, the split of its time, threads, a roofline",
          "per run at two contacts, a quarter for each contact more, and a twentieth for a unit of the default "
          "mix (default 200000)",
          kMaxContacts, ""},
    Suite{"problems", "those of the studies trade and extremes, a line of JSON for each setting of a dial",
          "of a setting of a dial, or of a generator at --contacts (default 25)", kMaxContacts, ""},
    Suite{"silent", "wrong answers that say nothing of it, counted over generators and dials",
          "in all (default 20000)", kMaxContacts, ""},
    Suite{"gate", "whether all that is called solved is, and what is left undecided, along dials",
          "of a setting of a dial (default 25)", kMaxContacts, ""},
    Suite{"gate-cost", "what it costs to judge forces, beside LU of the same A",
          "at most, of each number of contacts (default 400)", 100, ""},
    Suite{"scenes",
          "frames a second of the scenes of a folder, minimal and full models, or one thread and more", "",
          kMaxContacts, ""},
    Suite{"frames", "those of studies: lines of JSON, of the problems of --families and of each scene", "",
          kMaxContacts, ""},
    Suite{"peers", "stiction beside other packages, by the program stiction-peers",
          "of each number of contacts (default 400)", kMostOfAnySuite,
          "full half planar planar-half space space-half structure growth-frictionless growth-planar "
          "growth-walls growth-walls-in-space"},
    Suite{"random", "of it, random problems by the number of contacts",
          "of each number of contacts (default 400)", kMostOfAnySuite,
          "full half planar planar-half space space-half"},
    Suite{"structure", "of it, stacks, walls, scenes, nearly dependent rows", "at most, of a family",
          kMostOfAnySuite, "structure"},
    Suite{"peers-extremes", "of it, the dials of extremes, judged over rationals",
          "of a setting of a dial (default 400)", kMostOfAnySuite, "extremes-frictionless extremes"},
    Suite{"growth", "of it, time and memory at up to 10,000 contacts", "", 100000,
          "growth-frictionless growth-planar growth-walls growth-walls-in-space"},
    Suite{"engines", "scenes simulated beside Bullet, ODE, Box2D and MuJoCo, and what of them stands",
          "of the frames of a scene, at most (default: all)", kMostOfAnySuite, "engines"},
    Suite{"lemke", "a search beside Siconos's Lemke, at 2 to 5 contacts", "", 5, "lemke"},
};

struct BenchOptions {
  std::string suite = "search";
  std::vector<int> contacts;             // empty: the suite's own
  std::optional<std::int64_t> problems;  // empty: the suite's own
  int repeat = 5;
  std::int64_t seed = 1;
  std::string generator;                 // empty: all
  std::string scenes = "corpus/scenes";  // folder
  std::vector<std::string> families;     // of problems with structure, empty: all; levels of frames
  int threads = 1;                       // of a simulation, of `silent`
  bool json = false;
};

// InputError names what is wrong with the options.
int BenchSearch(const BenchOptions& options);    // search_rate.cpp
int BenchProblems(const BenchOptions& options);  // dials.cpp
int BenchSilent(const BenchOptions& options);    // gate.cpp: exit 1 where an answer is wrong
int BenchGate(const BenchOptions& options);      // likewise
int BenchGateCost(const BenchOptions& options);  // gate_cost.cpp
int BenchScenes(const BenchOptions& options);    // scenes.cpp
int BenchFrames(const BenchOptions& options);    // likewise
// Becomes the program stiction-peers, which stands beside this one (bench/peers).
int BenchPeers(const BenchOptions& options, std::string_view tables);

}  // namespace stiction
