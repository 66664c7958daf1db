// The report in plain words.
import { count, number, percent } from './format.js';

function certificate(checks) {
  const components = checks.components, small = checks.small_handles ?? 0, genus = checks.genus.reduce((a, b) => a + b, 0) - small;
  const needs = count(components, 'piece') + (genus > 0 ? ` and ${count(genus, 'loop')}, one for each handle` : ' and no loop')
    + (small > 0 ? `; ${count(small, 'handle')} too small for a loop left out` : '');
  if (checks.topology === 'proved')
    return { level: 'good', title: 'Topology proved', text: `The skeleton has exactly what the solid asks for: ${needs}. ${genus > 0 ? 'Each loop was shown to go round a handle of its own. ' : ''}This follows from the shape alone, however the skeleton was made.` };
  if (checks.topology === 'kept')
    return { level: 'fair', title: 'Topology counted, not proved', text: `The numbers are right (${needs}), but they cannot be proved to be the right ones: ${checks.reason}.` };
  return { level: 'bad', title: 'Topology wrong', text: `The solid asks for ${needs}; the skeleton has ${count(checks.b0, 'piece')} and ${count(checks.b1, 'loop')}. ${checks.reason}.` };
}

function inside(checks) {
  if (checks.edges_not_inside === 0) return { level: 'good', title: 'Inside everywhere', text: 'Every edge of the skeleton runs inside the solid from end to end.' };
  return { level: checks.inside > 0.99 ? 'fair' : 'bad', title: `${percent(checks.inside)} inside`, text: `${count(checks.edges_not_inside, 'edge')} of the skeleton ${checks.edges_not_inside === 1 ? 'is' : 'are'} not inside from end to end. The places are marked.` };
}

function surfaceRemarks(checks) {
  const remarks = [];
  if (checks.self_intersecting) remarks.push({ level: 'fair', title: 'The surface crosses itself', text: 'Where it does, inside and outside are a matter of opinion, and nothing can be proved there.' });
  if (checks.nested_components > 0) remarks.push({ level: 'note', title: count(checks.nested_components, 'shell lies within another', 'shells lie within others'), text: 'Each shell counts as a solid of its own.' });
  return remarks;
}

function warning(text) { return { level: 'fair', title: 'Warning', text: `${text[0].toUpperCase()}${text.slice(1)}.`.replace(/\.\.$/, '.') }; }

/** Remarks {level: good | note | fair | bad, title, text}, the certificate first. */
export function remarks(report) {
  if (!report) return [{ level: 'note', title: 'No report', text: 'This page was written without a report.' }];
  const list = report.checks ? [certificate(report.checks), inside(report.checks), ...surfaceRemarks(report.checks)] : [];
  return [...list, ...(report.warnings ?? []).map(warning)];
}

/** Pairs of a name and a value. */
export function facts(report, surface, graph, lengthUnit) {
  const counts = graph.counts(), genus = report?.input?.genus;
  const rows = [['Surface', `${count(surface.vertexCount, 'vertex', 'vertices')}, ${count(surface.faceCount, 'face')}`]];
  if (report?.input) rows.push(['', `${count(report.input.components, 'component')}, ${count(genus, 'handle')}`]);
  rows.push(['Skeleton', `${count(graph.nodeCount, 'node')}, ${count(graph.branches.length, 'branch', 'branches')}`]);
  rows.push(['', `${count(counts.pieces, 'piece')}, ${count(counts.loops, 'loop')}, ${count(counts.ends, 'end')}, ${count(counts.joints, 'joint')}`]);
  rows.push(['Length', number(counts.length)], ['Extent', number(2 * lengthUnit)]);
  return rows;
}

export const kKinds = { end: 'ends freely', link: 'between joints', loop: 'closed loop', whole: 'free at both ends' };
