// The picture: scene, lights, camera. Drawn only when something changed.
import {
  DirectionalLight, HemisphereLight, Mesh, MOUSE, Object3D, PerspectiveCamera, PlaneGeometry, Scene, ShadowMaterial,
  TOUCH, Vector3, PCFShadowMap, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { SketchCamera } from "../edit/sketch_doc.ts";
import type { Box, ShapeData } from "../shapes/shape.ts";

const defaultView = [0.42, 0.25, 1] as const;

/** Pixels that the bars at the top and at the bottom take. */
const topRoom = 56;
const bottomRoom = 90;

export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
  readonly controls: OrbitControls;
  private readonly renderer: WebGLRenderer;
  private readonly sun = new DirectionalLight(0xfff3e2, 2.6);
  private readonly fill = new DirectionalLight(0xcfe0ff, 0.75);
  private readonly rim = new DirectionalLight(0xffffff, 1.1);
  private readonly ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.2 }));
  private readonly listeners: (() => void)[] = [];
  private scheduled = false;
  private inset = 0;
  private drawing = false;
  private flat = false;
  private home = { position: new Vector3(), target: new Vector3() };

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 2.5;
    this.ground.rotation.x = -Math.PI / 2;
    this.ground.receiveShadow = true;
    const sky = new HemisphereLight(0xffffff, 0xb9a99a, 1.35);
    this.scene.add(sky, this.sun, this.sun.target, this.fill, this.rim, this.ground);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.invalidate());
    new ResizeObserver(() => {
      this.fit();
      this.draw(); // at once: a resized canvas is blank
    }).observe(canvas);
  }

  add(object: Object3D): void {
    this.scene.add(object);
  }

  /** Called before each drawing. */
  onDraw(listener: () => void): void {
    this.listeners.push(listener);
  }

  invalidate(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.draw();
    });
  }

  private draw(): void {
    for (const listener of this.listeners) listener();
    this.renderer.render(this.scene, this.camera);
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.setViewOffset(width, height, this.inset / 2, (bottomRoom - topRoom) / 2, width, height);
  }

  /** Centres the picture left of so many pixels at the right. */
  setInset(pixels: number): void {
    this.inset = pixels;
    this.fit();
    this.invalidate();
  }

  /** The middle of the picture, in pixels from the canvas's top left corner. */
  get middle(): { x: number; y: number } {
    return { x: (this.canvas.clientWidth - this.inset) / 2, y: (this.canvas.clientHeight - bottomRoom + topRoom) / 2 };
  }

  /** Looks at a new shape from `from`; scales light and ground to it. */
  frame(box: Box, { viewFrom = defaultView, dimension, hangs = 0 }: ShapeData): void {
    const radius = Math.max(box.diagonal / 2, 1e-9);
    this.flat = dimension === 2;
    this.setButtons();
    this.ground.visible = !this.flat;
    const center = new Vector3(...box.center).addScaledVector(new Vector3(0, -1, 0), hangs * box.diagonal);
    const tall = Math.max(0.86, (1.04 * (box.max[1] - box.min[1])) / Math.max(box.diagonal, 1e-9));
    const { clientWidth, clientHeight } = this.canvas;
    const narrow = Math.min(clientHeight - topRoom - bottomRoom, clientWidth - this.inset) / clientHeight;
    const distance = (tall * radius) / Math.sin((this.camera.fov * Math.PI) / 360) / narrow;
    this.camera.near = radius / 50;
    this.camera.far = radius * 60;
    this.camera.position.copy(center).addScaledVector(new Vector3(...viewFrom).normalize(), distance);
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(center);
    this.controls.minDistance = radius / 10;
    this.controls.maxDistance = radius * 20;
    this.home = { position: this.camera.position.clone(), target: center };
    this.light(center, radius);
    this.ground.visible = dimension === 3;
    this.ground.position.set(center.x, box.min[1] - 0.002 * radius - 2.4 * hangs * box.diagonal, center.z);
    this.ground.scale.setScalar(radius * 12);
    this.controls.update();
    this.invalidate();
  }

  goHome(): void {
    this.camera.position.copy(this.home.position);
    this.controls.target.copy(this.home.target);
    this.controls.update();
    this.invalidate();
  }

  private light(center: Vector3, radius: number): void {
    const place = (light: DirectionalLight, x: number, y: number, z: number) => {
      light.position.copy(center).addScaledVector(new Vector3(x, y, z), radius * 3);
      light.target.position.copy(center);
      light.target.updateMatrixWorld();
    };
    place(this.sun, 0.45, 1, 0.7);
    place(this.fill, -1, 0.3, 0.5);
    place(this.rim, -0.3, 0.6, -1);
    const shadow = this.sun.shadow;
    Object.assign(shadow.camera, {
      left: -2 * radius, right: 2 * radius, top: 2 * radius, bottom: -2 * radius, near: 0.1 * radius, far: 9 * radius,
    });
    shadow.camera.updateProjectionMatrix();
    shadow.bias = -0.0005;
    shadow.normalBias = 0.004 * radius;
  }

  // -- Between the scene and the screen -----------------------------------------------------------

  /** Pixels from the canvas's top left corner; `depth` beyond 1 lies behind the camera. */
  toScreen(point: Vector3): { x: number; y: number; depth: number } {
    this.camera.updateMatrixWorld();
    const p = point.clone().project(this.camera);
    const { clientWidth, clientHeight } = this.canvas;
    return { x: ((p.x + 1) / 2) * clientWidth, y: ((1 - p.y) / 2) * clientHeight, depth: p.z };
  }

  /** While strokes are drawn the right button and two fingers turn the camera, the middle button shifts it. */
  setDrawing(on: boolean): void {
    this.drawing = on;
    this.setButtons();
  }

  /** What lies in the plane is looked at from the front: dragging beside it shifts the picture. */
  private setButtons(): void {
    const { flat, drawing } = this;
    const LEFT = flat ? MOUSE.PAN : MOUSE.ROTATE;
    const turns = drawing && !flat;
    const [MIDDLE, RIGHT] = [drawing ? MOUSE.PAN : MOUSE.DOLLY, turns ? MOUSE.ROTATE : MOUSE.PAN];
    this.controls.mouseButtons = { LEFT, MIDDLE, RIGHT };
    const [ONE, TWO] = [flat ? TOUCH.PAN : TOUCH.ROTATE, turns ? TOUCH.DOLLY_ROTATE : TOUCH.DOLLY_PAN];
    this.controls.touches = { ONE, TWO };
  }

  /** The camera as the library knows it: the whole picture, of which the page shows a shifted part. */
  sketchCamera(): SketchCamera {
    const { up } = this.axes();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return {
      eye: this.camera.position.toArray(),
      target: this.controls.target.toArray(),
      up: up.toArray(),
      fovY: this.camera.fov,
      width,
      height,
    };
  }

  /** From pixels on the page to pixels of the sketch camera. */
  toPicture(clientX: number, clientY: number): readonly [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [clientX - box.left + this.inset / 2, clientY - box.top + (bottomRoom - topRoom) / 2];
  }

  /** A curve in space, three numbers a node, as pixels of the sketch camera. */
  curveInPicture(nodes: ArrayLike<number>): (readonly [number, number])[] {
    return this.curveOnScreen(nodes).map(({ x, y }) => [x + this.inset / 2, y + (bottomRoom - topRoom) / 2] as const);
  }

  /** The same in pixels from the canvas's top left corner. */
  curveOnScreen(nodes: ArrayLike<number>): { x: number; y: number }[] {
    return Array.from({ length: nodes.length / 3 }, (_, i) =>
      this.toScreen(new Vector3(nodes[3 * i], nodes[3 * i + 1], nodes[3 * i + 2])),
    );
  }

  /** From pixels on the page to -1 .. 1. */
  toClip(clientX: number, clientY: number): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: (2 * (clientX - box.left)) / box.width - 1, y: 1 - (2 * (clientY - box.top)) / box.height };
  }

  /** The shift in the view plane through `point` that a shift on the screen stands for. */
  shiftAt(point: Vector3, dx: number, dy: number): Vector3 {
    const forward = this.axes().forward;
    const depth = forward.dot(point.clone().sub(this.camera.position));
    const perPixel = (2 * depth * Math.tan((this.camera.fov * Math.PI) / 360)) / this.canvas.clientHeight;
    const { right, up } = this.axes();
    return right.multiplyScalar(dx * perPixel).addScaledVector(up, -dy * perPixel);
  }

  /** Unit vectors of the picture, in the scene. */
  axes(): { right: Vector3; up: Vector3; forward: Vector3 } {
    this.camera.updateMatrixWorld();
    const column = (k: number) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, k);
    return { right: column(0), up: column(1), forward: column(2).negate() };
  }

  /** Turns the camera around its target, in radians; for keys. */
  orbit(yaw: number, pitch: number): void {
    if (this.flat) return;
    const arm = this.camera.position.clone().sub(this.controls.target);
    arm.applyAxisAngle(new Vector3(0, 1, 0), yaw);
    const angle = arm.angleTo(new Vector3(0, 1, 0));
    const limited = Math.min(Math.PI - 0.05, Math.max(0.05, angle + pitch)) - angle;
    arm.applyAxisAngle(new Vector3(0, 1, 0).cross(arm).normalize(), limited);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
  }

  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  }
}
