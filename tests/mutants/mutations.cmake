# The mistakes that the field makes (THEORY, in brackets), one each. tests/image/mutants_test.cpp says where each shows.

# ---- candidates ------------------------------------------------------------------------------------------

restir_mutant(misses_not_counted "light candidates without light are not counted (section 2)"
    restir/di/candidates.glsl di/candidates
    [[    chosen.sum = 0.0;
]] [[    chosen.sum = 0.0;
    float misses = 0.0;
]]
    [[        if (!(pdf > 0.0)) continue;]]
    [[        if (!(pdf > 0.0)) {
            misses += 1.0;
            continue;
        }]]
    [[    return chosen;]]
    [[    chosen.sum *= float(candidates) / (float(candidates) - misses);
    return chosen;]])

restir_mutant(bsdf_share_without_visibility
    "what directions cannot find, being occluded, is weighed as if they could, then reused (section 2)"
    restir/di/candidates.glsl di/candidates
    [[either = visible && nb > 0.0]] [[either = nb > 0.0]])

restir_mutant(bsdf_density_without_count "p_b instead of n_b p_b (section 2)"
    restir/di/candidates.glsl di/candidates
    [[+ n.directions * pdf)]] [[+ pdf)]])

restir_mutant(one_round_counted "directions are weighed against the lights of one round of several (section 2)"
    restir/di/candidates.glsl di/candidates
    [[RsStrategies(source, nl, nb)]] [[RsStrategies(source, perRound, nb)]])

restir_mutant(mixed_measures "p_b per solid angle beside p_l per area (section 1)"
    restir/di/candidates.glsl di/candidates
    [[rsBridgeBsdfPdf(s, direct.incident.direction) * direct.incident.solidAngle;
    if (!(direct.target]]
    [[rsBridgeBsdfPdf(s, direct.incident.direction);
    if (!(direct.target]])

restir_mutant(light_drawn_off_its_pdf "light 0 is drawn half as often as its pdf says (section 2)"
    restir/lights/table.glsl di/candidates
    [[    return rsNextBits(random) < entry.threshold ? column : entry.alias;]]
    [[    uint id = rsNextBits(random) < entry.threshold ? column : entry.alias;
    return id == 0u && rsNext(random) < 0.5 ? 1u : id;]])

restir_mutant(receivers_density_missing "a point drawn for the receiver counts as one drawn uniformly (section 2)"
    restir/lights/table.glsl di/candidates
    [[    return chance * rsPdfLightUv(light, uv, incident, seen);]]
    [[    return chance;]])

restir_mutant(each_source_by_itself "what the tree draws is weighed by the tree's probability alone, and the same with the table (section 2)"
    restir/lights/source.glsl di/candidates
    [[    if (!(source.treeShare > 0.0)) return selection;]]
    [[    if (!(source.treeShare > 0.0)) return selection;
    if (draw.treeChance < 0.0) return (1.0 - source.treeShare) * selection;]])

restir_mutant(directions_forget_the_tree "what a direction hits is weighed as if lights were drawn by power alone (section 2)"
    restir/lights/source.glsl di/candidates
    [[    return rsLightChance(source, RsLightDraw(light, -1.0), selection, receiver, normal);]]
    [[    return selection;]])

restir_mutant(coin_reused "the random number that chose a light also decides whether it is kept (section 4, independent coins)"
    restir/di/candidates.glsl di/candidates
    [[        RsLightDraw draw = rsDrawLightFrom(source, receiver, s.normal, random);]]
    [[        RsRandom again = random;
        RsLightDraw draw = rsDrawLightFrom(source, receiver, s.normal, random);]]
    [[        float coin = rsNext(random);
        float pdf]]
    [[        float coin = rsNext(again);
        float pdf]])

restir_mutant(survivors_counted "an empty fresh reservoir has confidence 0 (section 2, counting)"
    restir/di/candidates.glsl di/candidates
    [[rsEmptyReservoir(di.freshConfidence)]] [[rsEmptyReservoir(0u)]])

# ---- spatial: the weights --------------------------------------------------------------------------------

restir_mutant(empty_is_rejected "empty neighbours leave S and the sum of c (section 3)"
    restir/di/spatial.glsl di/spatial
    [[        where.accepted |= 1u << i;]]
    [[        if (!rsHasSample(rsLoadSource(uvec2(at)))) continue;
        where.accepted |= 1u << i;]])

restir_mutant(off_labelled_pairwise "m_i = c_i / sum c where supports differ (section 4)"
    restir/di/combine.glsl di/spatial
    [[mis *= rsPairwiseShare(weights, canonicalConfidence, S) * there / (canonicalConfidence * here.target + S * there);]]
    [[mis /= S + canonicalConfidence;]]
    [[sums.canonicalMis * share + 1.0 - share]] [[cc / (S + cc)]])

restir_mutant(undefined_shift_skipped "where p^_i(Y_c) = 0 the term c_i / S of m_c is skipped (section 4)"
    restir/di/combine.glsl di/spatial
    [[        } else if (pairwise) {
            sums.canonicalMis +=]]
    [[        } else if (pairwise) {
            if (counts) sums.canonicalMis +=]])

restir_mutant(neighbours_visibility_missing "Cached's formula labelled Traced: killed samples, no V_i in m (section 4)"
    restir/di/combine.glsl di/spatial
    [[if (counts && traced && !itsOwn)]] [[if (counts && traced && !itsOwn && sampling)]])

restir_mutant(canonical_visibility_missing "no ray from the pixel itself to its neighbours' samples (section 4)"
    restir/di/combine.glsl di/spatial
    [[if (counts && traced && !itsOwn)]] [[if (counts && traced && !itsOwn && !sampling)]])

restir_mutant(balance_without_source_target "p^(Y) instead of p^_s(Y) over the balance heuristic's sum (section 4)"
    restir/di/combine.glsl di/spatial
    [[ucw *= selected.sourceTarget / sums.normalisation]] [[ucw *= selected.target / sums.normalisation]])

restir_mutant(basic_counts_everyone "1/M labelled 1/Z: pixels that cannot have the sample count, too (section 4)"
    restir/di/combine.glsl di/spatial
    [[counts ? c : 0.0;]] [[c;]])

restir_mutant(defensive_part_unscaled "the canonical's defensive share is added without scaling the rest (section 4)"
    restir/di/combine.glsl di/spatial
    [[sums.canonicalMis * share + 1.0 - share]] [[sums.canonicalMis + 1.0 - share]])

restir_mutant(larger_weight_wins "of the neighbours only the one with the largest W is taken (section 4, never on the outcome)"
    restir/di/spatial.glsl di/spatial
    [[        where.accepted |= 1u << i;
        where.confidence += float(rsConfidence(rsLoadSource(uvec2(at))));]]
    [[        RsReservoir taken = rsLoadSource(uvec2(at));
        if (where.accepted != 0u && taken.ucw <= rsLoadNeighbour(where, uint(findMSB(where.accepted))).reservoir.ucw) continue;
        where.accepted = 1u << i;
        where.confidence = float(rsConfidence(taken));]])

# ---- temporal --------------------------------------------------------------------------------------------

restir_mutant(current_lights_in_history "p^_prev with this frame's lights (section 5)"
    restir/di/temporal.glsl di/temporal
    [[rsLoadHistory(where.pixel), true)]] [[rsLoadHistory(where.pixel), false)]])

restir_mutant(current_camera_in_history "p^_prev at a position rebuilt with this frame's camera (section 5)"
    passes/bindings.glsl di/temporal
    [[rsFrame.previousView,
                           rsFrame.previousExtent, pixel);]]
    [[rsFrame.view,
                           rsFrame.previousExtent, pixel);]])

restir_mutant(appeared_light_in_history "a light that has appeared counts as one that the history could have held (section 5)"
    passes/bindings.glsl di/temporal
    [[    uvec4 first = rsPreviousLights[i];]]
    [[    if ((rsPreviousLights[i].w & RS_LIGHT_KIND_MASK) == RS_LIGHT_NONE) return rsLoadLight(id);
    uvec4 first = rsPreviousLights[i];]])

restir_mutant(growth_without_jacobian "W per area kept while the light grows, |J| = dA_now / dA_then omitted (section 5)"
    restir/di/temporal.glsl di/temporal
    [[    return RsNeighbour(rsLoadPreviousSurface(where.pixel), rsLoadHistory(where.pixel), true);]]
    [[    RsReservoir r = rsLoadHistory(where.pixel);
    RsPackedLight now = rsLoadLight(r.light), then = rsLoadPreviousLight(r.light);
    if (rsLightKind(now) == RS_LIGHT_TRIANGLE && rsLightKind(then) == RS_LIGHT_TRIANGLE)
        r.ucw *= length(cross(then.edge1, then.edge2)) / length(cross(now.edge1, now.edge2));
    return RsNeighbour(rsLoadPreviousSurface(where.pixel), r, true);]])

restir_mutant(cap_after_s "S is formed before the history is capped (section 2, counting)"
    restir/di/history.glsl di/temporal
    [[where.confidence = float(rsConfidence(rsLoadHistory(where.pixel)));]]
    [[where.confidence = float(rsConfidence(rsReservoirs[rsPass.source].at[rsPreviousIndex(where.pixel)]));]])

restir_mutant(confidence_from_weight "a history of large W is trusted less (section 4, never on the outcome)"
    passes/bindings.glsl di/temporal
    [[    r.confidence = min(rsConfidence(r), rsFrame.di.maxHistory)]]
    [[    r.confidence = min(rsConfidence(r), r.ucw > 3.0 ? 1u : rsFrame.di.maxHistory)]])

# ---- shading ---------------------------------------------------------------------------------------------

restir_mutant(final_ray_missing "no V in the shading of samples that were never traced (section 4, None)"
    restir/di/shade.glsl di/shade
    [[visibility != RS_VISIBILITY_TRACED && !rsUnoccluded]] [[visibility == RS_VISIBILITY_CACHED && !rsUnoccluded]])

restir_mutant(final_ray_written_back "None's final ray empties the reservoir that the next frame reuses (section 4, None)"
    passes/di/shade.glsl di/shade
    [[if (occluded && rsFrame.di.visibility == RS_VISIBILITY_CACHED)]] [[if (occluded)]])

# ---- partners ---------------------------------------------------------------------------------------------

restir_mutant(partner_without_the_sample_skipped "where the partner cannot have Y_c the term c_i / S of m_c is skipped (section 4)"
    restir/di/pair_spatial.glsl di/pair_spatial
    [[if (own > 0.0) canonicalMis]] [[if (own > 0.0 && pair.there > 0.0) canonicalMis]])

restir_mutant(notes_without_visibility "partners note targets of killed samples without V (section 4)"
    restir/di/pair_targets.glsl di/pair_targets
    [[if (asks && !rsUnoccluded(s, direct.incident))]] [[if (asks && !asks)]])

restir_mutant(jacobian_left_out_between_partners "paths move to partners per solid angle (section 6)"
    restir/gi/reservoir.glsl "gi/candidates;gi/pair_targets;gi/pair_spatial"
    [[float solidAngle = cosVertex / (distance * distance);]] [[float solidAngle = 1.0;]])

# ---- indirect light --------------------------------------------------------------------------------------

restir_mutant(jacobian_left_out "weights per solid angle move to other pixels as they are (section 6)"
    restir/gi/reservoir.glsl "gi/candidates;gi/spatial"
    [[float solidAngle = cosVertex / (distance * distance);]] [[float solidAngle = 1.0;]])

restir_mutant(jacobian_inverted "1 / |J| for |J| (section 6)"
    restir/gi/reservoir.glsl "gi/candidates;gi/spatial"
    [[float solidAngle = cosVertex / (distance * distance);]] [[float solidAngle = distance * distance / cosVertex;]])

restir_mutant(cosine_at_the_wrong_vertex "cos phi with the normal of the first vertex (section 6)"
    restir/gi/candidates.glsl gi/candidates
    [[RsGiReservoir r = rsVertexOf(there);]] [[RsGiReservoir r = rsVertexOf(there); r.geometricNormal = rsPackNormal(-s.geometricNormal);]])
