// Reflection at microfacets, as of rough metal or a rough coating.
// Based on: Cook and Torrance, A Reflectance Model for Computer Graphics, 1982; Walter, Marschner, Li
//           and Torrance, Microfacet Models for Refraction through Rough Surfaces, 2007 (GGX);
//           Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT
//           3(2), 2014; Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994
#pragma once

#include "compressor/material/brdfs.h"

namespace paim {

// "cook-torrance": f = D(h) G(in, out) F(in·h) / (4 cos θ_in cos θ_out), with the half vector h.
// D is GGX, with α = roughness² as in glTF and Burley, Physically-Based Shading at Disney, 2012. G is
// Smith's shadowing and masking, correlated by height (Heitz 2014, equation 99). F is Schlick's,
// ks + (1 − ks)(1 − in·h)^5. ks, the reflectance at normal incidence, is 0 … 1, and roughness
// 0.02 … 1. Light that facets reflect more than once is lost.
BrdfType cook_torrance();

}  // namespace paim
