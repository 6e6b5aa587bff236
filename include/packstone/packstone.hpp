#pragma once

/// @file
/// All of the library. Defines nothing.

#include "packstone/core/cell.hpp"
#include "packstone/core/error.hpp"
#include "packstone/core/mat.hpp"
#include "packstone/core/quaternion.hpp"
#include "packstone/core/random.hpp"
#include "packstone/core/run_context.hpp"
#include "packstone/core/vec.hpp"
#include "packstone/core/version.hpp"
#include "packstone/generate/rsa.hpp"
#include "packstone/geometry/body.hpp"
#include "packstone/geometry/bounds.hpp"
#include "packstone/geometry/contact.hpp"
#include "packstone/geometry/measures.hpp"
#include "packstone/geometry/support.hpp"
#include "packstone/io/draw.hpp"
#include "packstone/io/export_packing.hpp"
#include "packstone/io/packing_file.hpp"
#include "packstone/recipe/recipe.hpp"
#include "packstone/structure/check_packing.hpp"
#include "packstone/structure/distribution.hpp"
#include "packstone/structure/inclusion_mix.hpp"
#include "packstone/structure/orientation_law.hpp"
#include "packstone/structure/packing.hpp"
