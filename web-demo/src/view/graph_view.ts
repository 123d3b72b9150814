// The deformation graph over the shape: nodes coloured by the energy they hold, and edges.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  IcosahedronGeometry,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshBasicMaterial,
} from "three";
import type { State } from "../solver/pliant.ts";

const relaxed = new Color(0x2f6df0);
const strained = new Color(0xff3d3d);
/** Energies below this are those of rest, however small the others are. */
const quietest = 0.02;

export interface GraphState {
  nodes: ArrayLike<ArrayLike<number>>;
  edges: ArrayLike<ArrayLike<number>>;
  rotations: ArrayLike<ArrayLike<number>>;
  translations: ArrayLike<ArrayLike<number>>;
  /** One a node. */
  energies: readonly number[];
}

/** A state that holds a graph of nodes, whatever the method. */
export function graphIn(state: State | undefined): GraphState | undefined {
  const graph = state as unknown as Partial<GraphState> | undefined;
  const whole = graph?.nodes && graph.edges && graph.rotations && graph.translations && graph.energies;
  return whole ? (graph as GraphState) : undefined;
}

export class GraphView {
  readonly group = new Group();
  private nodes: InstancedMesh | undefined;
  private readonly lines: LineSegments;

  constructor() {
    const material = new LineBasicMaterial({ color: 0x4f7fe8, transparent: true, opacity: 0.3, depthTest: false });
    this.lines = new LineSegments(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
    this.group.add(this.lines);
  }

  /** Draws a graph, or nothing; `diagonal` is the shape's. */
  show(graph: GraphState | undefined, diagonal: number): void {
    this.group.visible = graph !== undefined;
    if (!graph) return;
    const at = (j: number): [number, number, number] =>
      [0, 1, 2].map((k) => graph.nodes[j]![k]! + graph.translations[j]![k]!) as [number, number, number];
    this.showEdges(graph, at);
    this.showNodes(graph, at, diagonal);
  }

  private showEdges(graph: GraphState, at: (j: number) => [number, number, number]): void {
    const ends = new Float32Array(6 * graph.edges.length);
    for (let e = 0; e < graph.edges.length; e++) {
      ends.set(at(graph.edges[e]![0]!), 6 * e);
      ends.set(at(graph.edges[e]![1]!), 6 * e + 3);
    }
    const current = this.lines.geometry.getAttribute("position") as BufferAttribute | undefined;
    if (current?.array.length === ends.length) {
      current.array.set(ends);
      current.needsUpdate = true;
    } else {
      this.lines.geometry.dispose();
      this.lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(ends, 3));
    }
  }

  private showNodes(graph: GraphState, at: (j: number) => [number, number, number], diagonal: number): void {
    const count = graph.nodes.length;
    if (this.nodes?.count !== count) this.makeNodes(count);
    const nodes = this.nodes!;
    const size = (0.03 * diagonal) / Math.sqrt(Math.max(count, 30) / 30);
    const { energies } = graph;
    const scale = Math.max(quietest, energies.toSorted()[Math.floor(0.97 * count)]!);
    const color = new Color();
    for (let j = 0; j < count; j++) {
      nodes.setMatrixAt(j, new Matrix4().makeScale(size, size, size).setPosition(...at(j)));
      nodes.setColorAt(j, color.lerpColors(relaxed, strained, Math.min(1, Math.sqrt(energies[j]! / scale))));
    }
    nodes.instanceMatrix.needsUpdate = true;
    nodes.instanceColor!.needsUpdate = true;
  }

  private makeNodes(count: number): void {
    if (this.nodes) {
      this.group.remove(this.nodes);
      this.nodes.dispose();
    }
    const material = new MeshBasicMaterial({ depthTest: false, transparent: true });
    this.nodes = new InstancedMesh(new IcosahedronGeometry(0.5, 2), material, count);
    this.nodes.frustumCulled = false;
    this.nodes.renderOrder = 2;
    this.group.add(this.nodes);
  }
}
