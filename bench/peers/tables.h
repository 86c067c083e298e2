// SPDX-License-Identifier: Apache-2.0
// The program stiction-peers: its options, its problems, and its tables.

#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bench/peers/contender.h"
#include "corpus/json_text.h"

namespace stiction {

struct PeersOptions {
  std::vector<std::string> tables;
  std::vector<int> contacts;             // empty: each table's own
  std::vector<std::string> families;     // of `structure`, scenes of `engines`; empty: all
  std::string scenes = "corpus/scenes";  // folder, for `structure`
  int problems = 400;
  double seconds = 0.3;
  double cap = 2;            // s, of the first problem, in whole seconds
  double structure_cap = 5;  // the same, of `structure`
  double growth_cap = 3;
  int frames = std::numeric_limits<int>::max();  // of `engines`, at most
  double engine_cap = 20;                        // s of processor time for an engine's frames of a scene
  std::uint64_t seed = 1;
  std::string examples;  // folder for the files of `extremes`; empty: none
  bool json = false;
};

// ---- Problems (problems.cpp) -----------------------------------------------------------

// A = J J' for J of rows x rank, entries uniform in [-1, 1]; b uniform in [-1, 1] where rank = rows, otherwise
// rank = rows / 2 and b = J y, y uniform: about half of the contacts are active. mu uniform in [1/10, 1], one
// per contact. Frictionless contacts, or static ones in the plane.
PeerProblem MakePlanar(int contacts, bool friction, bool full_rank, std::uint64_t seed);

// Static contacts in space between rigid bodies at rest, and the world: A = J M^-1 J', b = J M^-1 F. Normals
// are uniform on the sphere, points uniform in a cube about each body's centre, independent for the two bodies
// of a contact; masses and principal inertias from 1/2 to 2, forces and torques F uniform; mu as above.
// `definite`: contact i joins body i to an earlier body or the world, so that the rows of J are independent.
// Otherwise contacts / 4 bodies, at least one, which have rank 3/2 contacts of 3 contacts.
PeerProblem MakeSpatial(int contacts, bool definite, std::uint64_t seed);

// ---- Tables ----------------------------------------------------------------------------------

// Names of the tables of contenders, in their order; MeasureTable knows them (random.cpp).
std::vector<std::string> PeerTableNames();
Json MeasureTable(const std::string& name, const PeersOptions& o);

// Families of problems with structure (structure.cpp).
Json MeasureStructure(const PeersOptions& o);

// Along dials (extremes.cpp): without friction, where all packages mean the same law, and with it.
Json MeasureExtremes(bool friction, const PeersOptions& o);

// A search beside Siconos's Lemke (lemke.cpp): {"rows": [...]}.
Json MeasureLemke(const PeersOptions& o);

// Time, memory and counts by the number of contacts (growth.cpp).
Json MeasureGrowth(bool friction, const PeersOptions& o);
Json MeasureWallGrowth(int dimension, const PeersOptions& o);

// Scenes simulated beside engines (engines.cpp).
std::vector<std::string> EngineSceneNames();
Json MeasureEngines(const PeersOptions& o);

}  // namespace stiction
